#pragma once

#include <filesystem>
#include <string>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads a scene of Radiance (docs/formats.md says what becomes of it): a description or, where the
/// extension of `file` is .rif, a project that names descriptions. Other files lie in the folder of
/// `file` or below it. Throws InputError with file, line and column at the first thing that is
/// wrong.
SceneFile parse_radiance(const std::string& text, const std::filesystem::path& file);

/// The same from a file, at most 64 MiB long.
SceneFile read_radiance(const std::filesystem::path& path);

}  // namespace isolux
