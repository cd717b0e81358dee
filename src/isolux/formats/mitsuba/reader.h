#pragma once

#include <filesystem>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads a scene of Mitsuba 3 (docs/formats.md says what becomes of its elements). Throws
/// InputError with file, line and column at the first thing that is wrong.
SceneFile read_mitsuba(const std::filesystem::path& path);

}  // namespace isolux
