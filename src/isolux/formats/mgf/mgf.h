#pragma once

#include <filesystem>
#include <string>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads a scene in the Materials and Geometry Format, version 2 (docs/formats.md says what becomes
/// of its entities). Included files lie in the folder of `file` or below it. Throws InputError with
/// file, line and column at the first thing that is wrong.
SceneFile parse_mgf(const std::string& text, const std::filesystem::path& file);

/// The same from a file, at most 64 MiB long.
SceneFile read_mgf(const std::filesystem::path& path);

}  // namespace isolux
