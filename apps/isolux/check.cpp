#include "isolux/scene/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <thread>

#include "arguments.h"
#include "commands.h"
#include "exit_code.h"
#include "interruption.h"
#include "isolux/core/parallel.h"
#include "isolux/inspection/inspect.h"
#include "isolux/radiosity/furnace.h"
#include "isolux/radiosity/solve.h"
#include "isolux/radiosity/stopwatch.h"
#include "isolux/scene/spelling.h"
#include "memory.h"
#include "output.h"
#include "progress_line.h"
#include "scene_input.h"

namespace isolux {
namespace {

struct Arguments {
  SceneInput scene;
  bool furnace = false;
  Options options;
  double seconds = 0;  // at most; 0: no bound
  int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
};

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

std::string describe(const std::map<std::string, std::size_t>& primitives) {
  std::string text;
  for (const auto& [kind, count] : primitives) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", kind, count);
  }
  return text;
}

std::string describe_escape(const Inspection& inspection) {
  const auto& [rays, escaped, warnings] = inspection;
  if (rays == 0) return "closed or open: not known, without lamp or camera";
  if (escaped == 0) return fmt::format("closed: of {} rays of light, none leaves it", rays);
  return fmt::format("open: of {} rays of light, {:.3g} % leave it", rays,
                     100.0 * double(escaped) / double(rays));
}

void check(const Scene& scene, const Arguments& a, const std::vector<std::string>& notes,
           double scene_memory) {
  const SceneReport report = check_scene(scene);
  const Inspection inspection = inspect_scene(RayCaster(scene));
  std::string text = fmt::format(
      "{}: {}\n"
      "objects {}, materials {}, cameras {}, lights {} with {:.6g} lm together\n"
      "primitives: {}\n"
      "plain numbers are in {}; bounds {} m\n"
      "{}{}\n"
      "memory: {:.3g} MB for the scene, {:.3g} MB at most until now\n\n"
      "   area m²    flux lm  object (material), bounds in m\n",
      a.scene.path.string(), report.name.empty() ? "(no name)" : report.name, report.object_count,
      report.materials, report.cameras, report.lights, report.flux, describe(report.primitives),
      report.unit, describe(report.bounds),
      report.sky ? "sky: " + describe(*report.sky) + "\n" : "", describe_escape(inspection),
      scene_memory / 1e6, peak_memory() / 1e6);
  for (const ObjectReport& object : report.objects) text += describe(object);
  if (const std::size_t more = report.object_count - report.objects.size()) {
    text += fmt::format("{:23}and {} more\n", "", more);
  }
  std::size_t count = 0;
  for (const auto* warnings : {&notes, &report.warnings, &inspection.warnings}) {
    count += warnings->size();
    for (const std::string& warning : *warnings) {
      fmt::format_to(std::back_inserter(text), "\nwarning: {}", warning);
    }
  }
  text += count == 0 ? "\nnothing doubtful\n" : "\n";
  print(text);
}

std::string describe(const FurnaceReport& report, const Scene& furnace) {
  const auto share = [&](double flux) {
    return report.emitted_flux > 0 ? 100 * flux / report.emitted_flux : 0;
  };
  return fmt::format(
      "deviation   {:.3g} % root mean square over the area\n"
      "            {:+.3g} % at worst, on {} at ({:.6g} {:.6g} {:.6g})\n"
      "energy      {:.6g} lm emitted: absorbed {:.3f} %, escaped {:.3f} %, unshot {:.3f} %, "
      "unaccounted for {:.3f} %\n",
      100 * report.rms, 100 * report.worst, in_quotes(furnace.objects[report.object].name),
      report.place.x, report.place.y, report.place.z, report.emitted_flux,
      share(report.absorbed_flux), share(report.escaped_flux), share(report.unshot_flux),
      share(report.unaccounted()));
}

Solved solve_furnace(const Scene& furnace, const Arguments& a) {
  const Interruption interruption;
  ProgressLine line(false);
  const Stopwatch stopwatch;
  return solve(furnace, a.options, [&](const Progress& progress) {
    line.show(progress);
    return !interruption.requested() && !(a.seconds > 0 && stopwatch.wall() >= a.seconds);
  });
}

void prove(const Scene& scene, const Arguments& a) {
  constexpr double kExitance = 100;  // B₀, lm/m²
  const Scene furnace = furnace_scene(scene, kExitance);
  const Solved solved = solve_furnace(furnace, a);
  const Statistics& s = solved.statistics;
  std::string text = fmt::format(
      "{}: a furnace, its exitance B = {:g} lm/m² everywhere if light is neither lost nor made\n"
      "solve       {}{} triangles on {:.6g} m², {} vertices, {:.1f} s\n",
      a.scene.path.string(), kExitance,
      s.interrupted ? "interrupted, "
      : s.converged ? ""
                    : "tolerance not met, ",
      s.triangles, s.mesh_area, s.vertices, s.wall_seconds);
  // Until there is an estimate of the error, surfaces are not lit yet.
  if (s.converged || s.error > 0)
    text += describe(judge_furnace(furnace, solved.mesh, s, kExitance), furnace);
  print(text);
  if (!s.converged) throw CLI::RuntimeError(kGoalNotReached);
}

void run(const Arguments& a) {
  const ThreadLimit limit(a.threads);
  const double before = allocated_memory();
  const SceneFile file = a.scene.load();
  const double scene_memory = allocated_memory() - before;
  a.furnace ? prove(file.scene, a) : check(file.scene, a, file.notes, scene_memory);
}

}  // namespace

void add_check(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App& command =
      *program.add_subcommand("check", "What a scene says, what in it is wrong or doubtful");
  add_scene(command, a->scene);
  CLI::Option* const furnace =
      command.add_flag("--furnace", a->furnace, "proves it by a solve whose light is known");
  add_percentage(command, "--tolerance", a->options.tolerance, 0.01, 100,
                 "of the furnace, root mean square error")
      ->needs(furnace);
  add_number(command, "--time", "S", a->seconds, 0.0, 1e9, "stop the furnace then, 0: no bound")
      ->needs(furnace);
  add_number(command, "--threads", "N", a->threads, 1, 1024, "at most; changes no result");
  command.footer(
      "Exit code 0, whatever is doubtful; 3 where a furnace ended before its tolerance\n"
      "was met.");
  command.callback([a] { run(*a); });
}

}  // namespace isolux
