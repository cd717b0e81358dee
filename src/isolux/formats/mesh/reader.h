#pragma once

#include <filesystem>

#include "isolux/formats/scene_file.h"

namespace isolux {

// Meshes without materials or lights: one object in PLY, one a solid in STL, of a grey that
// reflects 0.5, seen from both sides.

SceneFile read_ply(const std::filesystem::path& path);
SceneFile read_stl(const std::filesystem::path& path);

}  // namespace isolux
