#pragma once

#include <filesystem>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads the tree that OpenSCAD exports as .csg, with the lights that stand beside it
/// (docs/formats.md). Throws InputError with file, line and column.
SceneFile read_openscad(const std::filesystem::path& path);

}  // namespace isolux
