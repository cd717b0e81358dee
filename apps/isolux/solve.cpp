#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>

#include "arguments.h"
#include "commands.h"
#include "interruption.h"
#include "isolux/core/file.h"
#include "isolux/core/parallel.h"
#include "isolux/core/version.h"
#include "isolux/radiosity/solve.h"
#include "isolux/scene/reader.h"
#include "isolux/solution/metadata.h"
#include "isolux/solution/solution.h"
#include "output.h"
#include "progress_line.h"

namespace isolux {
namespace {

enum class Preset { paper };

struct Arguments {
  std::filesystem::path scene, output, stats;
  Preset preset = Preset::paper;
  Options options;
  int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  bool quiet = false;
};

void add_refinement(CLI::App& command, Options& o) {
  add_number(command, "--max-edge", "M", o.rules.max_edge, 1e-6, 1e6, "δ: longest edge, m");
  add_number(command, "--min-area", "M2", o.rules.min_area, 1e-15, 1e12,
             "Δ: least area that a split makes, m²");
  add_angle(command, "--normal-tolerance", o.rules.normal_tolerance, 0.1, 89.9,
            "α_n: between a triangle's normals, °");
  add_number(command, "--contrast", "X", o.contrast, 0.0, 1e6,
             "α_s: split where ΔB's differ by α_s × mean");
  add_number(command, "--rays", "N", o.grid, 1, 4096, "N × N jittered rays from each corner");
  add_number(command, "--least-rays", "N", o.least_rays, 0, 16000000,
             "extra uniform rays from each corner");
  add_choice(command, "--distribution", o.distribution,
             {{"malley", Distribution::malley}, {"uniform", Distribution::uniform}},
             "of rays: malley or uniform");
  add_number(command, "--eye-rays", "N", o.eye_grid, 0, 4096,
             "N × N rays of the eye pass, 0: none");
  add_number(command, "--pairing-tolerance", "X", o.pairing_tolerance, 1e-9, 0.99,
             "of a ray's two hits, × the distance");
}

void add_transfer(CLI::App& command, Options& o) {
  add_number(command, "--iterations", "N", o.iterations, 0, 100000000, "shots at most");
  add_number(command, "--stop-at-unshot", "X", o.stop_at_unshot, 0.0, 0.99,
             "stop at this part of the power unshot");
  add_choice(command, "--selection", o.selection,
             {{"radiosity", Selection::radiosity}, {"power", Selection::power}},
             "shoot by radiosity or by power");
  add_number(command, "--subdivisions", "N", o.subdivisions, 0, 8,
             "of emitters that are half hidden");
}

void save_statistics(const Statistics& statistics, const std::filesystem::path& path) {
  nlohmann::json object = statistics_to_json(statistics);
  object["cpu_seconds"] = statistics.cpu_seconds;
  object["wall_seconds"] = statistics.wall_seconds;
  write_file(path, object.dump(2) + "\n");
}

double unshot_fraction(const Statistics& s) {
  return s.emitted_flux > 0 ? s.unshot_flux / s.emitted_flux : 0;
}

std::string summary(const Arguments& a, const Statistics& s) {
  return fmt::format("{}{}: {} iterations, {} triangles on {:.3g} m², {:.1f} s",
                     s.interrupted ? "interrupted; the solution so far is in " : "",
                     a.output.string(), s.iterations, s.triangles, s.mesh_area, s.wall_seconds);
}

/// What the user should know before trusting the numbers; empty where nothing is doubtful.
std::string caution(const Arguments& a, const Statistics& s, double scene_size) {
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

Solved solve_with_progress(const Scene& scene, const Arguments& a,
                           const Interruption& interruption) {
  ProgressLine line(a.quiet);
  return solve(scene, a.options, [&](const Progress& progress) {
    line.show(progress);
    return !interruption.requested();
  });
}

void run(const Arguments& a) {
  check_output(a.output, {".glb"});
  if (!a.stats.empty()) check_output(a.stats, {".json"});

  const ThreadLimit limit(a.threads);
  Scene scene = load_scene(a.scene);
  Interruption interruption;
  Solved solved = solve_with_progress(scene, a, interruption);
  interruption.ignore();

  const Statistics statistics = solved.statistics;
  const double scene_size = scene.bounds().diagonal();
  save_solution({std::move(scene), std::move(solved.mesh), a.options, statistics, kVersion},
                a.output);
  if (!a.stats.empty()) save_statistics(statistics, a.stats);
  if (a.quiet) return;
  say(summary(a, statistics));
  const std::string doubt = caution(a, statistics, scene_size);
  if (!doubt.empty()) say("caution: " + doubt);
}

}  // namespace

void add_solve(CLI::App& program) {
  const auto a = std::make_shared<Arguments>();
  CLI::App& command = *program.add_subcommand("solve", "Scene to solution: its mesh and its light");
  command.add_option("SCENE", a->scene, "the scene, in YAML")->required()->option_text(" ");
  command.add_option("-o,--output", a->output, "the solution")->required()->option_text("FILE.glb");
  add_choice(command, "--preset", a->preset, {{"paper", Preset::paper}},
             "paper: the method of Lalonde (1993)");
  add_refinement(command, a->options);
  add_transfer(command, a->options);
  command.add_option("--camera", a->options.camera, "whose eye the eye pass takes [the first]")
      ->option_text("NAME");
  add_number(command, "--seed", "N", a->options.seed, std::uint64_t{0},
             std::numeric_limits<std::uint64_t>::max(), "of all random numbers");
  add_number(command, "--threads", "N", a->threads, 1, 1024, "at most; changes no result");
  command.add_option("--stats", a->stats, "writes counts, fluxes and times too")
      ->option_text("FILE.json");
  command.add_flag("--quiet", a->quiet, "says nothing but errors");
  command.footer("Ctrl-C ends the solve early; what is there is saved, and the exit code is 0.");
  command.callback([a] { run(*a); });
}

}  // namespace isolux
