#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "arguments.h"
#include "commands.h"
#include "exit_code.h"
#include "interruption.h"
#include "isolux/core/file.h"
#include "isolux/core/parallel.h"
#include "isolux/core/version.h"
#include "isolux/radiosity/solve.h"
#include "isolux/radiosity/stopwatch.h"
#include "isolux/solution/checkpoint.h"
#include "isolux/solution/metadata.h"
#include "isolux/solution/solution.h"
#include "memory.h"
#include "output.h"
#include "progress_line.h"
#include "scene_input.h"

namespace isolux {
namespace {

struct Arguments {
  SceneInput scene;
  std::filesystem::path output, stats, checkpoint, resume;
  Options options;
  double seconds = 0;    // at most; 0: no bound
  double megabytes = 0;  // at most; 0: no bound
  int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  bool quiet = false;
};

using OptionList = std::vector<CLI::Option*>;

OptionList add_refinement(CLI::App& command, Options& o) {
  return {
      add_number(command, "--max-edge", "M", o.rules.max_edge, 1e-6, 1e6, "δ: longest edge, m"),
      add_number(command, "--min-area", "M2", o.rules.min_area, 1e-15, 1e12,
                 "Δ: least area that a split makes, m²"),
      add_angle(command, "--normal-tolerance", o.rules.normal_tolerance, 0.1, 89.9,
                "α_n: between a triangle's normals, °"),
      add_number(command, "--contrast", "X", o.contrast, 0.0, 1e6,
                 "α_s: split where ΔB's differ by α_s × mean"),
      add_number(command, "--rays", "N", o.grid, 1, 4096, "N × N jittered rays from each corner"),
      add_number(command, "--least-rays", "N", o.least_rays, 0, 16000000,
                 "extra uniform rays from each corner"),
      add_choice(command, "--distribution", o.distribution,
                 {{"malley", Distribution::malley}, {"uniform", Distribution::uniform}},
                 "of rays: malley or uniform"),
      add_number(command, "--eye-rays", "N", o.eye_grid, 0, 4096,
                 "N × N rays of the eye pass, 0: none"),
      add_number(command, "--pairing-tolerance", "X", o.pairing_tolerance, 1e-9, 0.99,
                 "of a ray's two hits, × the distance"),
      command.add_option("--camera", o.camera, "whose eye the eye pass takes [the first]")
          ->option_text("NAME"),
  };
}

OptionList add_transfer(CLI::App& command, Options& o) {
  return {
      add_number(command, "--iterations", "N", o.iterations, 0, 100000000, "shots at most"),
      add_number(command, "--stop-at-unshot", "X", o.stop_at_unshot, 0.0, 0.99,
                 "stop at this part of the power unshot"),
      add_choice(command, "--selection", o.selection,
                 {{"radiosity", Selection::radiosity}, {"power", Selection::power}},
                 "shoot by radiosity or by power"),
      add_number(command, "--subdivisions", "N", o.subdivisions, 0, 8,
                 "of emitters that are half hidden"),
  };
}

/// The paper's method and its parameters, which belong to nothing else.
CLI::Option* add_preset(CLI::App& command, Options& o) {
  CLI::Option* preset = add_choice(command, "--preset", o.method, {{"paper", Method::shooting}},
                                   "paper: as Lalonde (1993)");
  for (const OptionList& list : {add_refinement(command, o), add_transfer(command, o)}) {
    for (CLI::Option* option : list) option->needs(preset)->group("With --preset paper");
  }
  return preset;
}

/// How good the solution gets, and what it may cost.
void add_goal(CLI::App& command, Arguments& a, CLI::Option* preset) {
  add_percentage(command, "--tolerance", a.options.tolerance, 0.01, 100,
                 "root mean square error of illuminance")
      ->excludes(preset);
  add_number(command, "--max-triangles", "N", a.options.max_triangles, std::uint64_t{0},
             std::uint64_t{4'000'000'000}, "refine no further, 0: no bound")
      ->excludes(preset);
  add_number(command, "--max-memory", "MB", a.megabytes, 0.0, 1e9, "stop there, 0: no bound");
  add_number(command, "--time", "S", a.seconds, 0.0, 1e9, "stop then, 0: no bound");
  command.add_option("--checkpoint", a.checkpoint, "kept up to date, for --resume")
      ->option_text("FILE.checkpoint")
      ->excludes(preset);
  command.add_option("--resume", a.resume, "goes on from a checkpoint, as if never stopped")
      ->option_text("FILE.checkpoint")
      ->excludes(preset);
}

void save_statistics(const Statistics& statistics, double scene_memory,
                     const std::filesystem::path& path) {
  nlohmann::json object = statistics_to_json(statistics);
  object["cpu_seconds"] = statistics.cpu_seconds;
  object["wall_seconds"] = statistics.wall_seconds;
  object["scene_bytes"] = static_cast<std::uint64_t>(scene_memory);
  object["peak_bytes"] = static_cast<std::uint64_t>(peak_memory());
  write_file(path, object.dump(2) + "\n");
}

double unshot_fraction(const Statistics& s) {
  return s.emitted_flux > 0 ? s.unshot_flux / s.emitted_flux : 0;
}

std::string percent(double share) { return fmt::format("{:.2g} %", 100 * share); }

/// How the solve ended, where it did not come to its end.
std::string ending(const Statistics& s) {
  return s.interrupted ? "interrupted; the solution so far is in " : "";
}

std::string summary(const Arguments& a, const Statistics& s) {
  if (a.options.method == Method::shooting) {
    return fmt::format("{}{}: {} iterations, {} triangles on {:.3g} m², {:.1f} s", ending(s),
                       a.output.string(), s.iterations, s.triangles, s.mesh_area, s.wall_seconds);
  }
  return fmt::format(
      "{}{}: {:.4g} lx on average, {}, {} triangles on {:.3g} m², {:.1f} s", ending(s),
      a.output.string(), s.mean_irradiance,
      s.error > 0 ? fmt::format("± {} estimated", percent(s.error)) : "error not estimated yet",
      s.triangles, s.mesh_area, s.wall_seconds);
}

/// What the user should know before trusting the numbers of the paper's method; empty where
/// nothing is doubtful.
std::string caution_of_shooting(const Arguments& a, const Statistics& s, double scene_size) {
  constexpr double kMuchUnshot = 0.05;
  if (a.options.rules.max_edge > scene_size / 4) {
    return fmt::format(
        "--max-edge {:.3g} m is long for a scene {:.3g} m across: light that falls "
        "where no triangle fits is lost; make it shorter",
        a.options.rules.max_edge, scene_size);
  }
  if (unshot_fraction(s) <= kMuchUnshot) return {};
  return fmt::format(
      "{:.0f} % of the light is still unshot and missing from all illuminances; "
      "raise --iterations{}",
      100 * unshot_fraction(s),
      a.options.selection == Selection::power ? "" : ", or take --selection power");
}

std::string caution(const Arguments& a, const Statistics& s, double scene_size) {
  if (a.options.method == Method::shooting) return caution_of_shooting(a, s, scene_size);
  if (s.converged) return {};
  return fmt::format("the tolerance of {} is not met", percent(a.options.tolerance));
}

/// Ends the solve where the user or a bound says so.
bool may_go_on(const Arguments& a, const Interruption& interruption, const Stopwatch& stopwatch) {
  if (interruption.requested()) return false;
  if (a.seconds > 0 && stopwatch.wall() >= a.seconds) return false;
  return !(a.megabytes > 0 && peak_memory() >= a.megabytes * 1e6);
}

/// Writes checkpoints, but spends no more than a tenth of the time on them.
class CheckpointWriter {
 public:
  /// Writes none where `path` is empty.
  CheckpointWriter(const Scene& scene, const Options& options, const std::filesystem::path& path)
      : scene_(scene), options_(options), path_(path) {}

  void offer(const GatheringState& state) {
    const double now = stopwatch_.wall();
    if (path_.empty() || now < next_) return;
    save_checkpoint(scene_, options_, state, path_);
    next_ = stopwatch_.wall() + std::max(1.0, 10 * (stopwatch_.wall() - now));
  }

 private:
  const Scene& scene_;
  const Options& options_;
  const std::filesystem::path& path_;
  const Stopwatch stopwatch_;
  double next_ = 0;  // s
};

Solved solve_with_progress(const Scene& scene, const Arguments& a,
                           const Interruption& interruption) {
  ProgressLine line(a.quiet);
  const Stopwatch stopwatch;
  const auto progress = [&](const Progress& p) {
    line.show(p);
    return may_go_on(a, interruption, stopwatch);
  };
  if (a.options.method == Method::shooting) return solve(scene, a.options, progress);

  CheckpointWriter writer(scene, a.options, a.checkpoint);
  std::optional<GatheringState> from;
  if (!a.resume.empty()) from = load_checkpoint(scene, a.options, a.resume);
  const auto checkpoint = [&](const GatheringState& state) { writer.offer(state); };
  return solve_by_gathering(scene, a.options, {progress, checkpoint}, std::move(from));
}

bool goal_reached(const Arguments& a, const Statistics& s) {
  return !s.interrupted && (a.options.method == Method::shooting || s.converged);
}

void run(const Arguments& a) {
  check_output(a.output, {".glb"});
  if (!a.stats.empty()) check_output(a.stats, {".json"});
  if (!a.checkpoint.empty()) check_output(a.checkpoint, {".checkpoint"});

  const ThreadLimit limit(a.threads);
  const double before = allocated_memory();
  auto [scene, notes] = a.scene.load(a.quiet);
  const double scene_memory = allocated_memory() - before;
  if (!a.quiet) {
    for (const std::string& note : notes) say("note: " + note);
  }
  Interruption interruption;
  Solved solved = solve_with_progress(scene, a, interruption);
  interruption.ignore();

  const Statistics statistics = solved.statistics;
  const double scene_size = scene.bounds().diagonal();
  save_solution({std::move(scene), std::move(solved.mesh), a.options, statistics, kVersion},
                a.output);
  if (!a.stats.empty()) save_statistics(statistics, scene_memory, a.stats);
  if (!a.quiet) {
    say(summary(a, statistics));
    const std::string doubt = caution(a, statistics, scene_size);
    if (!doubt.empty()) say("caution: " + doubt);
  }
  if (!goal_reached(a, statistics)) throw CLI::RuntimeError(kGoalNotReached);
}

}  // namespace

void add_solve(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App& command = *program.add_subcommand("solve", "Scene to solution: its mesh and its light");
  add_scene(command, a->scene);
  command.add_option("-o,--output", a->output, "the solution")->required()->option_text("FILE.glb");
  CLI::Option* preset = add_preset(command, a->options);
  add_goal(command, *a, preset);
  add_number(command, "--seed", "N", a->options.seed, std::uint64_t{0},
             std::numeric_limits<std::uint64_t>::max(), "of all random numbers");
  add_number(command, "--threads", "N", a->threads, 1, 1024, "at most; changes no result");
  command.add_option("--stats", a->stats, "writes counts, fluxes, times, memory too")
      ->option_text("FILE.json");
  command.add_flag("--quiet", a->quiet, "says nothing but errors");
  command.footer(
      "Ctrl-C ends the solve early and saves what there is. Exit code 3 where that, or\n"
      "a bound, came before the tolerance was met.");
  command.callback([a] { run(*a); });
}

}  // namespace isolux
