#include "scene_input.h"

#include <optional>

#include "exit_code.h"
#include "interruption.h"
#include "output.h"
#include "progress_line.h"

namespace isolux {

SceneFile SceneInput::load(bool quiet) const {
  const Interruption interruption;
  std::optional<SceneFile> file;
  try {
    ProgressLine line(quiet);
    file = load_scene_file(path, format, [&](const ReadingProgress& progress) {
      line.show(progress);
      return !interruption.requested();
    });
  } catch (const ReadingStopped&) {
  }
  if (file && !interruption.requested()) return std::move(*file);
  say("interrupted while reading the scene; nothing is written");
  throw CLI::RuntimeError(kGoalNotReached);
}

void add_scene(CLI::App& command, SceneInput& scene) {
  command.add_option("SCENE", scene.path, "the scene, in YAML or another format")
      ->required()
      ->option_text(" ");
  command.add_option("--format", scene.format, "of the scene [by its extension]")
      ->option_text("NAME");
}

}  // namespace isolux
