#pragma once

#include <filesystem>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads a scene of Rayshade 4 (docs/formats.md says what becomes of what), in metres. Included
/// files lie in its folder or below. Throws InputError with file, line and column at the first
/// thing that is wrong.
SceneFile read_rayshade(const std::filesystem::path& path);

}  // namespace isolux
