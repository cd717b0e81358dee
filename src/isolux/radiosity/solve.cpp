#include "isolux/radiosity/solve.h"

#include <fmt/format.h>

#include <atomic>

#include "isolux/core/error.h"
#include "isolux/core/parallel.h"
#include "isolux/radiosity/energy.h"
#include "isolux/radiosity/gathering.h"
#include "isolux/radiosity/refine.h"
#include "isolux/radiosity/spatial_order.h"
#include "isolux/radiosity/stopwatch.h"
#include "isolux/radiosity/vertex_luminance.h"
#include "isolux/radiosity/visibility.h"
#include "isolux/scene/spelling.h"

namespace isolux {

// Notation of §3.2.1
//   T          the triangle that shoots          Shot
//   T.B        its unshot radiosity, lm/m²       Shot::radiosity (as printed, T.B would be shot
//                                                again and again, and energy diverge)
//   V.ΔB, V.B  = ρ × Vertex::delta_irradiance, ρ × Vertex::irradiance
//   R.ΔB       unshot_radiosity(R)

namespace {

/// The brightest triangle and the unshot light of all, found in one pass.
struct Brightest {
  TriangleId triangle = 0;
  double measure = 0;      // unshot radiosity or power, of either sign
  double unshot_flux = 0;  // lm
};

Brightest brightest_triangle(const Triangulation& mesh, std::span<const double> radiosity,
                             Selection selection) {
  Brightest best;
  const auto triangles = mesh.triangles();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const Triangle& triangle = triangles[i];
    if (!triangle.alive) continue;
    const auto& [a, b, c] = triangle.vertices;
    const double received = (radiosity[a] + radiosity[b] + radiosity[c]) / 3;
    const double unshot = std::abs(luminance(triangle.emission - triangle.shot) + received);
    const double flux = unshot * triangle.area;
    best.unshot_flux += flux;
    const double measure = selection == Selection::power ? flux : unshot;
    if (measure > best.measure) {
      best.measure = measure;
      best.triangle = static_cast<TriangleId>(i);
    }
  }
  return best;
}

/// T sends what it has: afterwards nothing of it is unshot.
Shot take_shot(Triangulation& mesh, TriangleId id) {
  Triangle& triangle = mesh.triangle(id);
  const Shot shot{id, emitter_of(mesh, id), unshot_radiosity(mesh, triangle)};
  triangle.shot += shot.radiosity;
  return shot;
}

/// For each vertex V ∉ T: V.ΔB ← V.ρ × T.B × F_{V–T}; V.B ← V.B + V.ΔB; their luminances too.
/// Returns the number of shadow rays.
std::uint64_t calculate_vertex_radiosities(Triangulation& mesh, SpatialOrder& spatial_order,
                                           VertexLuminance& luminance, const Shot& shot,
                                           const RayCaster& rays, int subdivisions) {
  constexpr std::size_t kGrain = 512;
  const std::span<const VertexId> order = spatial_order.of(mesh);
  std::vector<double> factor(order.size());  // F_{V–T}, by vertex
  std::atomic<std::uint64_t> ray_count = 0;
  parallel_for(order.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::array<double, kGrain> factors;
    const auto receivers = spatial_order.receivers().subspan(begin, end - begin);
    ray_count += visible_form_factors(rays, shot.emitter, receivers, subdivisions,
                                      {factors.data(), receivers.size()});
    for (std::size_t i = begin; i < end; ++i) factor[order[i]] = factors[i - begin];
  });
  for (VertexId corner : mesh.triangle(shot.triangle).vertices) factor[corner] = 0;
  // In the order of memory, so that it need not be waited for.
  parallel_for(factor.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<VertexId>(begin); v < end; ++v) {
      Vertex& vertex = mesh.vertex(v);
      vertex.delta_irradiance = shot.radiosity * factor[v];
      vertex.irradiance += vertex.delta_irradiance;
      luminance.read(v, vertex);
    }
  });
  return ray_count;
}

/// Trees over triangles and saved solutions hold coordinates in single precision.
void check_place(const Bounds& bounds) {
  constexpr double kFarthest = 1000;
  const double away = length(bounds.center()), size = bounds.diagonal();
  if (away > kFarthest * size) {
    throw InputError(fmt::format(
        "the scene, {:.3g} m across, lies {:.3g} m from the origin: move it nearer, to within {} "
        "times its size",
        size, away, kFarthest));
  }
}

}  // namespace

void check_options(const Options& options) {
  const auto require = [](bool holds, const char* text) {
    if (!holds) throw InputError(text);
  };
  require(options.tolerance >= 1e-4 && options.tolerance <= 1,
          "the tolerance must lie between 0.01 % and 100 %");
  require(options.contrast >= 0, "the contrast α_s must not be negative");
  require(options.iterations >= 0 && options.iterations <= 100'000'000,
          "the number of iterations must lie between 0 and 100,000,000");
  require(options.grid >= 1 && options.grid <= 4096,
          "the ray grid must have between 1 and 4096 cells a side");
  require(options.least_rays >= 0 && options.least_rays <= 16'000'000,
          "the least number of rays must lie between 0 and 16,000,000");
  require(options.eye_grid >= 0 && options.eye_grid <= 4096,
          "the eye pass must have between 0 and 4096 rays a side");
  require(options.pairing_tolerance > 0 && options.pairing_tolerance < 1,
          "the pairing tolerance must lie between 0 and 1");
  require(options.subdivisions >= 0 && options.subdivisions <= 8,
          "the emitter subdivisions must lie between 0 and 8");
  require(options.stop_at_unshot >= 0 && options.stop_at_unshot < 1,
          "the unshot fraction to stop at must lie between 0 and 1");
}

void discretize_lights(const Scene& scene, double max_edge, Triangulation& mesh) {
  if (!scene.sources.empty()) {
    throw InputError(
        fmt::format("light {} has no surface: the paper's method knows only lights "
                    "that have one, so solve without it",
                    in_quotes(scene.sources.front().name)));
  }
  if (scene.sky) {
    throw InputError(
        "the scene has a sky: the paper's method knows only lights that have a surface, so solve "
        "without it");
  }
  bool any = false;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!object.emits()) continue;
    const std::optional<TriangleSoup> soup = object.shape->triangulate(max_edge);
    if (!soup) {
      throw InputError(
          fmt::format("light '{}' has a shape that can't be cut into triangles", object.name));
    }
    mesh.add_light(*soup, {i, 0}, scene.material_of(i).reflectance, object.exitance);
    any = true;
  }
  if (!any) throw InputError("the scene has no light: give an object an 'emission'");
}

Statistics transfer_energy(Triangulation& mesh, const RayCaster& rays, const Options& options,
                           const ProgressCallback& progress) {
  const Stopwatch stopwatch;
  Statistics statistics;
  Refinement refinement(mesh, rays, options, statistics);
  statistics.emitted_flux = energy_of(mesh).emitted_flux;
  const double enough = options.stop_at_unshot * statistics.emitted_flux;

  if (options.refine && options.eye_grid > 0 && !rays.scene().cameras.empty()) {
    refinement.refine_from_eye(rays.scene().camera(options.camera));
  }
  SpatialOrder order;
  VertexLuminance luminance;
  luminance.add_newborn(mesh);
  Brightest brightest = brightest_triangle(mesh, luminance.radiosity, options.selection);
  while (statistics.iterations < options.iterations) {
    const Shot shot = take_shot(mesh, brightest.triangle);
    statistics.shadow_rays +=
        calculate_vertex_radiosities(mesh, order, luminance, shot, rays, options.subdivisions);
    if (options.refine) {
      refinement.refine(shot);
      luminance.add_newborn(mesh);
      refinement.split_triangles(shot, luminance.delta_irradiance);
      luminance.add_newborn(mesh);
    }
    brightest = brightest_triangle(mesh, luminance.radiosity, options.selection);
    ++statistics.iterations;

    statistics.converged = brightest.unshot_flux <= enough;
    if (statistics.converged) break;
    if (progress) {
      const double seconds = stopwatch.wall();
      const auto ray_count =
          static_cast<double>(statistics.refinement_rays + statistics.shadow_rays);
      const int left = options.iterations - statistics.iterations;
      if (!progress({statistics.iterations, options.iterations, 0,
                     brightest.unshot_flux / statistics.emitted_flux, mesh.triangle_count(),
                     ray_count / std::max(seconds, 1e-9),
                     seconds / statistics.iterations * left})) {
        statistics.interrupted = true;
        break;
      }
    }
  }

  const Energy energy = energy_of(mesh);
  statistics.unshot_flux = energy.unshot_flux;
  statistics.ambient_exitance = energy.ambient_exitance;
  statistics.mesh_area = energy.area;
  statistics.triangles = mesh.triangle_count();
  statistics.vertices = mesh.vertices().size();
  statistics.cpu_seconds = stopwatch.cpu();
  statistics.wall_seconds = stopwatch.wall();
  return statistics;
}

Solved solve(const Scene& scene, const Options& options, const ProgressCallback& progress) {
  if (options.method == Method::gathering) {
    return solve_by_gathering(scene, options, {progress, {}});
  }
  check_options(options);
  check_place(scene.bounds());
  const RayCaster rays(scene);
  Solved solved{Triangulation(options.rules, scene.bounds()), {}};
  discretize_lights(scene, options.rules.max_edge, solved.mesh);
  solved.statistics = transfer_energy(solved.mesh, rays, options, progress);
  return solved;
}

Solved solve_by_gathering(const Scene& scene, const Options& options,
                          const GatheringCallbacks& callbacks, std::optional<GatheringState> from) {
  check_options(options);
  check_place(scene.bounds());
  const RayCaster rays(scene);
  if (!from) from.emplace(Triangulation(gathering_rules(scene), scene.bounds()));
  gather_radiosity(*from, rays, options, callbacks);
  return {std::move(from->mesh), from->statistics};
}

}  // namespace isolux
