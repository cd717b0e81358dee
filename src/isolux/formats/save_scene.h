#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

/// Writes the scene, whole or not at all, in the format that the file's extension names: .yaml and
/// .yml native, .mgf MGF, .rad Radiance. Returns what that format doesn't hold, or holds changed: a
/// line for each kind. Throws InputError where it can't hold an object, or where the file can't be
/// written.
std::vector<std::string> save_scene(const Scene& scene, const std::filesystem::path& path);

}  // namespace isolux
