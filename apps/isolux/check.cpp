#include "isolux/scene/check.h"

#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <string>

#include "commands.h"
#include "output.h"
#include "scene_input.h"

namespace isolux {
namespace {

std::string describe(const Bounds& b) {
  return fmt::format("({:.6g} {:.6g} {:.6g}) to ({:.6g} {:.6g} {:.6g})", b.lower.x, b.lower.y,
                     b.lower.z, b.upper.x, b.upper.y, b.upper.z);
}

std::string describe(const ObjectReport& object) {
  const std::string area = object.area ? fmt::format("{:.5g}", *object.area) : "?";
  const std::string flux = object.flux > 0 ? fmt::format("{:.5g}", object.flux) : "-";
  return fmt::format("{:>10}  {:>9}  {} ({})\n{:24}{}\n", area, flux, object.name, object.material,
                     "", describe(object.bounds));
}

void run(const SceneInput& input) {
  const SceneFile file = input.load();
  SceneReport report = check_scene(file.scene);
  report.warnings.insert(report.warnings.begin(), file.notes.begin(), file.notes.end());
  std::string text = fmt::format(
      "{}: {}\n"
      "objects {}, materials {}, cameras {}, lights {} with {:.6g} lm together\n"
      "plain numbers are in {}; bounds {} m\n\n"
      "   area m²    flux lm  object (material), bounds in m\n",
      input.path.string(), report.name.empty() ? "(no name)" : report.name, report.objects.size(),
      report.materials, report.cameras, report.lights, report.flux, report.unit,
      describe(report.bounds));
  for (const ObjectReport& object : report.objects) text += describe(object);
  for (const std::string& warning : report.warnings) {
    fmt::format_to(std::back_inserter(text), "\nwarning: {}", warning);
  }
  text += report.warnings.empty() ? "\nnothing doubtful\n" : "\n";
  print(text);
}

}  // namespace

void add_check(CLI::App& program) {
  const auto scene = std::make_shared<SceneInput>();
  CLI::App& command =
      *program.add_subcommand("check", "What a scene says, what in it is wrong or doubtful");
  add_scene(command, *scene);
  command.callback([scene] { run(*scene); });
}

}  // namespace isolux
