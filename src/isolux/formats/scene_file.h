#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "isolux/scene/reading_progress.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// A scene as a reader understood it.
struct SceneFile {
  Scene scene;
  /// What the file asks for and diffuse surfaces can't give: one line for each kind, with what was
  /// done instead.
  std::vector<std::string> notes;
};

/// The names of the formats that load_scene_file() reads; the native one is "isolux".
std::vector<std::string> format_names();

/// Reads a scene of any known format, chosen by the file's extension or, where it is not empty, by
/// `format`, one of format_names(). Throws InputError as load_scene() does, with file, line and
/// column in whichever file of several the fault lies, and where the extension is not known. The
/// scene has its native text as `source`, whatever the format. Throws
/// ReadingStopped where `progress` says so; it is asked between the steps of reading other formats,
/// and within those of the native one, which come after them.
SceneFile load_scene_file(const std::filesystem::path& path, const std::string& format = {},
                          const ReadingCallback& progress = {});

}  // namespace isolux
