#include "isolux/measure/measure.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/radiosity/gather.h"
#include "isolux/radiosity/illumination.h"

namespace isolux {
namespace {

/// The point as a receiver. Coordinates written with few digits may lie inside a solid: such a
/// point is lifted off it, at most by 10⁻⁴ of the scene.
Receiver receiver_of(const MeasurePoint& point, const RayCaster& rays) {
  double lift = 0;
  for (double next : {1e1, 1e2, 1e3}) {
    if (!rays.buried(point.position + point.normal * lift, point.normal)) break;
    lift = next * rays.epsilon();
  }
  return {point.position + point.normal * lift, point.normal};
}

/// From every triangle of the solution.
void from_triangles(const Solution& solution, const RayCaster& rays,
                    std::span<const Receiver> receivers, std::span<Measurement> measurements) {
  std::vector<Rgb> irradiance(receivers.size());
  gather_irradiance(solution.mesh, rays, receivers, solution.options.subdivisions, irradiance);
  for (std::size_t i = 0; i < irradiance.size(); ++i) measurements[i].irradiance = irradiance[i];
}

/// As the vertices of the solution gathered theirs.
void by_rays(const Solution& solution, const RayCaster& rays, std::span<const Receiver> receivers,
             std::span<Measurement> measurements) {
  const std::vector<Illumination> found =
      gather_at(solution.mesh, rays, solution.statistics, receivers, solution.options.seed);
  for (std::size_t i = 0; i < found.size(); ++i) {
    measurements[i].irradiance = found[i].irradiance;
    measurements[i].error = found[i].error;
  }
}

void check_distance(std::span<const MeasurePoint> points, const Bounds& bounds) {
  const double size = bounds.diagonal();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double away = distance(points[i].position, bounds.center());
    if (away <= 1000 * size) continue;
    throw InputError(fmt::format(
        "point {} lies {:.3g} m from the scene, which is {:.3g} m across; give coordinates in m",
        i + 1, away, size));
  }
}

}  // namespace

std::vector<Measurement> measure(const Solution& solution, std::span<const MeasurePoint> points) {
  check_distance(points, solution.scene.bounds());
  const RayCaster rays(solution.scene);
  std::vector<Receiver> receivers;
  receivers.reserve(points.size());
  for (const MeasurePoint& p : points) receivers.push_back(receiver_of(p, rays));
  std::vector<Measurement> measurements;
  measurements.reserve(points.size());
  for (const MeasurePoint& point : points) measurements.push_back({point, {}, {}});
  if (solution.options.method == Method::shooting) {
    from_triangles(solution, rays, receivers, measurements);
  } else {
    by_rays(solution, rays, receivers, measurements);
  }
  return measurements;
}

}  // namespace isolux
