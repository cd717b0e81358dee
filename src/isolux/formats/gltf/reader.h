#pragma once

#include <filesystem>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads a scene in glTF 2.0, as JSON or packed (docs/formats.md says what becomes of its parts).
/// Throws InputError, with line and column where the JSON is malformed, else with the path of the
/// value that is wrong; also where the file is a solution of isolux.
SceneFile read_gltf(const std::filesystem::path& path);

}  // namespace isolux
