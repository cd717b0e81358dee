#include <fmt/format.h>

#include <filesystem>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "commands.h"
#include "isolux/discretization/coverage.h"
#include "isolux/solution/solution.h"
#include "output.h"

namespace isolux {
namespace {

/// What the mesh says of one object: each corner of a triangle stands for a third of its area.
struct ObjectLight {
  double area = 0;    ///< m²
  Rgb incident_flux;  ///< lm
};

std::vector<ObjectLight> light_of_objects(const Solution& solution) {
  std::vector<ObjectLight> objects(solution.scene.objects.size());
  for (const Triangle& triangle : solution.mesh.triangles()) {
    if (!triangle.alive) continue;
    for (const VertexId id : triangle.vertices) {
      const Vertex& vertex = solution.mesh.vertex(id);
      ObjectLight& object = objects[vertex.surface.object];
      object.area += triangle.area / 3;
      object.incident_flux += vertex.irradiance * (triangle.area / 3);
    }
  }
  return objects;
}

std::string describe_scene(const Scene& scene) {
  std::string cameras;
  for (const Camera& camera : scene.cameras) {
    cameras += fmt::format("{}{} ({} × {})", cameras.empty() ? "" : ", ", camera.name, camera.width,
                           camera.height);
  }
  const Bounds b = scene.bounds();
  return fmt::format(
      "scene       {}\n"
      "            objects {}, materials {}, bounds ({:.6g} {:.6g} {:.6g}) to ({:.6g} {:.6g} "
      "{:.6g}) m\n"
      "cameras     {}\n{}",
      scene.name.empty() ? "(no name)" : scene.name, scene.objects.size(), scene.materials.size(),
      b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z,
      cameras.empty() ? "none" : cameras,
      scene.sky ? "sky         " + describe(report_sky(*scene.sky)) + "\n" : "");
}

std::string describe_options(const Options& o) {
  if (o.method == Method::gathering) {
    return fmt::format(
        "options     tolerance {:.4g} %, seed {}{}\n", 100 * o.tolerance, o.seed,
        o.max_triangles > 0 ? fmt::format(", at most {} triangles", o.max_triangles) : "");
  }
  return fmt::format(
      "options     δ {:.6g} m, Δ {:.6g} m², α_n {:.4g}°, α_s {:.6g}, seed {}\n"
      "            {} × {} {} rays a corner and {} more, {} × {} from the eye{}{}\n"
      "            at most {} shots by {}, down to {:.6g} unshot, {} subdivisions\n",
      o.rules.max_edge, o.rules.min_area, o.rules.normal_tolerance * 180 / std::numbers::pi,
      o.contrast, o.seed, o.grid, o.grid,
      o.distribution == Distribution::malley ? "Malley" : "uniform", o.least_rays, o.eye_grid,
      o.eye_grid, o.camera.empty() ? "" : " of camera " + o.camera,
      o.refine ? "" : ", no refinement", o.iterations,
      o.selection == Selection::power ? "power" : "radiosity", o.stop_at_unshot, o.subdivisions);
}

std::string describe_gathering(const Statistics& s) {
  const char* end = s.interrupted ? "interrupted"
                    : s.converged ? "tolerance met"
                                  : "tolerance not met";
  const auto share = [&](double flux) {
    return s.emitted_flux > 0 ? 100 * flux / s.emitted_flux : 0;
  };
  const std::string error =
      s.error > 0 ? fmt::format("estimated error {:.2g} %: interpolation {:.2g} %, rays {:.2g} %",
                                100 * s.error, 100 * s.discretization_error, 100 * s.sampling_error)
                  : "error not estimated yet";
  const std::string narrow =
      s.narrow_error > 0
          ? fmt::format("; steps of light too narrow for the mesh: {:.2g} %", 100 * s.narrow_error)
          : "";
  return fmt::format(
      "solve       {} ({} rounds), {} vertices gathered {} rays on average\n"
      "mesh        {} triangles, {} vertices ({} by splits), {:.6g} m²\n"
      "energy      {:.6g} lm emitted: absorbed {:.2f} %, escaped {:.2f} %, unshot {:.2f} %, "
      "unaccounted for {:.2f} %\n"
      "illuminance {:.6g} lx on average, {}{}\n",
      end, s.iterations, s.gatherers, s.gather_rays, s.triangles, s.vertices, s.split, s.mesh_area,
      s.emitted_flux, share(s.absorbed_flux), share(s.escaped_flux), share(s.unshot_flux),
      share(s.imbalance), s.mean_irradiance, error, narrow);
}

std::string describe_shooting(const Statistics& s) {
  const char* end = s.interrupted ? "interrupted" : s.converged ? "converged" : "all shots made";
  const double unshot = s.emitted_flux > 0 ? 100 * s.unshot_flux / s.emitted_flux : 0;
  return fmt::format(
      "solve       {} iterations ({}), {} refinement rays, {} shadow rays\n"
      "mesh        {} triangles, {} vertices ({} by extension, {} by splits), {} removed\n"
      "            {:.6g} m²\n"
      "energy      {:.6g} lm emitted, {:.6g} lm ({:.1f} %) unshot, ambient term {:.6g} lm/m²\n",
      s.iterations, end, s.refinement_rays, s.shadow_rays, s.triangles, s.vertices, s.extended,
      s.split, s.removed, s.mesh_area, s.emitted_flux, s.unshot_flux, unshot, s.ambient_exitance);
}

/// How much of the surface carries triangles, to some 0.05 %.
std::string describe_coverage(const Solution& solution) {
  constexpr int kLines = 20'000;
  const RayCaster rays(solution.scene);
  const Coverage coverage = coverage_of(solution.mesh, rays, kLines, solution.options.seed);
  if (!(coverage.area > 0)) return "";
  return fmt::format("coverage    {:.1f} % of the surface that light can reach\n",
                     100 * coverage.covered / coverage.area);
}

std::string describe_objects(const Solution& solution) {
  std::string text = "\n   mesh m²  surface m²    mean lx  object\n";
  const std::vector<ObjectLight> objects = light_of_objects(solution);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const Object& object = solution.scene.objects[i];
    const auto area = object.shape->area();
    const ObjectLight& light = objects[i];
    const double mean = light.area > 0 ? luminance(light.incident_flux) / light.area : 0;
    fmt::format_to(std::back_inserter(text), "{:10.5g}  {:>10}  {:>9}  {}{}\n", light.area,
                   area ? fmt::format("{:.5g}", *area) : "?",
                   light.area > 0 ? fmt::format("{:.5g}", mean) : "-", object.name,
                   object.emits() ? " (light)" : "");
  }
  return text;
}

void run(const std::filesystem::path& path) {
  const Solution solution = load_solution(path);
  print(fmt::format("{}: a solution by isolux {}\n", path.string(), solution.version) +
        describe_scene(solution.scene) + describe_options(solution.options) +
        (solution.options.method == Method::gathering ? describe_gathering(solution.statistics)
                                                      : describe_shooting(solution.statistics)) +
        describe_coverage(solution) + describe_objects(solution));
}

}  // namespace

void add_info(CLI::App& program) {
  const auto path = std::make_shared<std::filesystem::path>();
  CLI::App& command = *program.add_subcommand("info", "What is in a solution");
  command.add_option("FILE.glb", *path, "the solution")->required()->option_text(" ");
  command.callback([path] { run(*path); });
}

}  // namespace isolux
