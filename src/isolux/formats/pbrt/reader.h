#pragma once

#include <filesystem>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads a scene of pbrt, version 3 or 4 (docs/formats.md says what becomes of its directives).
/// Throws InputError with file, line and column at the first thing that is wrong.
SceneFile read_pbrt(const std::filesystem::path& path);

}  // namespace isolux
