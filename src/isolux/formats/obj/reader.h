#pragma once

#include <filesystem>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Reads polygons in the OBJ format, with materials in MTL files beside it (docs/formats.md says
/// what becomes of them). Throws InputError with file, line and column at the first thing that is
/// wrong.
SceneFile read_obj(const std::filesystem::path& path);

}  // namespace isolux
