#pragma once

#include <filesystem>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads a scene of Rayshade 4 (docs/formats-rayshade.md says what becomes of what).
SceneFile read_rayshade(const std::filesystem::path& path);

}  // namespace isolux
