#include "scene_input.h"

namespace isolux {

void add_scene(CLI::App& command, SceneInput& scene) {
  command.add_option("SCENE", scene.path, "the scene, in YAML or another format")
      ->required()
      ->option_text(" ");
  command.add_option("--format", scene.format, "of the scene [by its extension]")
      ->option_text("NAME");
}

}  // namespace isolux
