#include <filesystem>
#include <memory>
#include <string>

#include "commands.h"
#include "isolux/formats/save_scene.h"
#include "output.h"
#include "scene_input.h"

namespace isolux {
namespace {

struct Arguments {
  SceneInput scene;
  std::filesystem::path output;
};

void run(const Arguments& a) {
  check_output(a.output, {".yaml", ".yml", ".mgf", ".rad"});
  check_distinct(a.scene.path, a.output);
  const SceneFile file = a.scene.load();
  const std::vector<std::string> lost = save_scene(file.scene, a.output);
  for (const std::string& note : file.notes) say("note: " + note);
  for (const std::string& note : lost) say("note: " + note);
}

}  // namespace

void add_convert(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App& command = *program.add_subcommand("convert", "Scene to another format");
  add_scene(command, a->scene);
  command.add_option("-o,--output", a->output, "the format is that of the extension")
      ->required()
      ->option_text("FILE.yaml|.mgf|.rad");
  command.footer("What a format can't hold is noted on stderr, or an error that names the object.");
  command.callback([a] { run(*a); });
}

}  // namespace isolux
