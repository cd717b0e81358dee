#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// A scene as the command line names it.
struct SceneInput {
  std::filesystem::path path;
  std::string format;  ///< empty: by the path's extension

  /// Reads it, with a line of progress unless `quiet`. Ctrl-C ends the program, with a word and
  /// kGoalNotReached, before anything is written.
  SceneFile load(bool quiet = false) const;
};

/// Adds the argument SCENE and the option --format.
void add_scene(CLI::App& command, SceneInput& scene);

}  // namespace isolux
