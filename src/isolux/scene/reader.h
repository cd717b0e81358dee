#pragma once

#include <filesystem>
#include <string>

#include "isolux/scene/reading_progress.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// Reads a scene in the native format (docs/scene-format.md), strictly. `file` is the name that
/// errors give. Throws InputError with file, line and column at the first thing that is wrong: an
/// unknown or repeated key (with the nearest known one), a wrong type, a number that is not finite
/// or out of range, a missing material, an empty scene. Throws ReadingStopped where
/// `progress` says so.
Scene read_scene(const std::string& text, const std::string& file,
                 const ReadingCallback& progress = {});

/// The same from a file, at most 256 MiB long.
Scene load_scene(const std::filesystem::path& path, const ReadingCallback& progress = {});

}  // namespace isolux
