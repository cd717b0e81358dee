#include "isolux/radiosity/source_light.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "isolux/core/random.h"

namespace isolux {
namespace {

/// Whether the ray ends on a side that receives light.
bool arrives(const RayCaster& rays, const Ray& ray) {
  const std::optional<SurfaceHit> hit = rays.nearest(ray);
  return hit && dot(hit->normal, ray.direction) < 0;
}

}  // namespace

void add_source_light(const RayCaster& rays, const Source& source,
                      std::span<const Receiver> receivers, std::span<Rgb> irradiance) {
  const bool directional = source.kind == Source::Kind::directional;
  // From beyond everything.
  const Vec3 back = source.direction * (-2 * rays.scene().bounds().diagonal());
  thread_local std::vector<std::uint32_t> lit;
  thread_local std::vector<Rgb> light;
  thread_local std::vector<Segment> segments;
  thread_local std::vector<std::uint8_t> blocked;
  lit.clear(), light.clear(), segments.clear();
  Bounds from, to;
  for (std::uint32_t i = 0; i < receivers.size(); ++i) {
    const auto& [point, normal] = receivers[i];
    const Vec3 d = directional ? back : source.position - point;
    const double away = length(d);
    const double cosine = dot(d, normal) / away;
    if (!(cosine > 0)) continue;
    const double part = directional ? 1 : source.beam(-d / away) / (away * away);
    if (!(part > 0)) continue;
    lit.push_back(i);
    light.push_back(source.intensity * (part * cosine));
    const Vec3 start = point + normal * rays.epsilon();
    segments.push_back({start, directional ? start + back : source.position});
    from.include(segments.back().from);
    to.include(segments.back().to);
  }
  if (lit.empty()) return;
  blocked.assign(lit.size(), 0);
  const Blockers blockers = rays.blockers(from, to);
  if (!blockers.none()) rays.occluded(blockers, segments, blocked);
  for (std::size_t k = 0; k < lit.size(); ++k) {
    if (!blocked[k]) irradiance[lit[k]] += light[k];
  }
}

double arriving_flux(const RayCaster& rays, const Source& source) {
  constexpr int kGrid = 128;  // strata a side
  const Frame frame(source.direction);
  const Bounds bounds = rays.scene().bounds();
  const double radius = bounds.diagonal() / 2;
  Random random(0, 0);
  double sum = 0;
  for (int j = 0; j < kGrid; ++j) {
    for (int i = 0; i < kGrid; ++i) {
      const double u = (i + random.uniform()) / kGrid, v = (j + random.uniform()) / kGrid;
      const double angle = 2 * std::numbers::pi * u;
      Ray ray{source.position, source.direction};
      double flux = 0;  // of one ray, were it alone
      if (source.kind == Source::Kind::directional) {
        const double r = radius * std::sqrt(v);
        const Vec3 across{r * std::cos(angle), r * std::sin(angle), -2 * radius};
        ray.origin = bounds.center() + frame.to_world(across);
        flux = luminance(source.intensity) * std::numbers::pi * radius * radius;
      } else {
        const double dark = source.cos_dark(), cosine = 1 - v * (1 - dark);
        const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        ray.direction = frame.to_world({sine * std::cos(angle), sine * std::sin(angle), cosine});
        flux = luminance(source.intensity) * source.beam(ray.direction) * 2 * std::numbers::pi *
               (1 - dark);
      }
      if (flux > 0 && !arrives(rays, ray)) continue;
      sum += flux;
    }
  }
  return sum / (kGrid * kGrid);
}

double arriving_flux(const RayCaster& rays, const Sky& sky) {
  constexpr int kGrid = 512;  // strata of directions a side
  // Steps of Roberts's (2018) sequence in two dimensions: powers of the root of x³ = x + 1.
  constexpr double kStep = 0.7548776662466927, kOtherStep = 0.5698402909980532;
  const Bounds bounds = rays.scene().bounds();
  const double radius = bounds.diagonal() / 2;
  Random random(0, 0);
  double sum = 0;
  for (int k = 0; k < kGrid * kGrid; ++k) {
    const double z = 1 - 2 * (k / kGrid + random.uniform()) / kGrid;
    const double azimuth = 2 * std::numbers::pi * (k % kGrid + random.uniform()) / kGrid;
    const double s = std::sqrt(std::max(0.0, 1 - z * z));
    const Frame frame({s * std::cos(azimuth), s * std::sin(azimuth), z});
    const double light = luminance(sky.luminance(frame.n));
    if (!(light > 0)) continue;
    const double r = radius * std::sqrt(std::fmod(k * kStep, 1));
    const double angle = 2 * std::numbers::pi * std::fmod(k * kOtherStep, 1);
    const Vec3 across{r * std::cos(angle), r * std::sin(angle), 2 * radius};
    if (arrives(rays, {bounds.center() + frame.to_world(across), -frame.n})) sum += light;
  }
  // Each ray stands for its part of 4π sr and of the disk across it.
  return sum / (kGrid * kGrid) * 4 * std::numbers::pi * std::numbers::pi * radius * radius;
}

}  // namespace isolux
