#include "isolux/radiosity/hemisphere_gather.h"

#include <algorithm>
#include <numbers>

#include "isolux/core/parallel.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {

/// A direction of the unit disk, in polar coordinates.
struct Polar {
  double radius, angle;
};

/// The point (a, b) of the square [−1, 1]² on the disk: rings of the square become rings of the
/// disk, areas keep their ratios (Shirley & Chiu 1997).
Polar concentric(double a, double b) {
  constexpr double kEighth = std::numbers::pi / 4;
  if (a == 0 && b == 0) return {0, 0};
  if (std::abs(a) > std::abs(b)) return {a, kEighth * (b / a)};
  return {b, 2 * kEighth - kEighth * (a / b)};
}

/// The mean over all cells of the variance of one jittered point in the cell, from the second
/// differences along both directions of the grid; at its rim, those of the cell next to it.
double variance_in_cells(std::span<const double> values, int grid) {
  const auto squared = [&](int i, int j, int step) {
    const auto at = static_cast<std::size_t>(j * grid + i);
    const auto s = static_cast<std::size_t>(step);
    const double difference = values[at - s] - 2 * values[at] + values[at + s];
    return difference * difference;
  };
  const auto inner = [&](int k) { return std::clamp(k, 1, grid - 2); };
  double sum = 0;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      sum += squared(inner(i), j, 1) + squared(i, inner(j), grid);
    }
  }
  return sum / (12.0 * grid * grid);
}

/// The variance of the values as they are.
double variance(std::span<const double> values) {
  if (values.size() < 2) return values.empty() ? 0 : values[0] * values[0];
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return squares / (n - 1);
}

template <typename Ray, typename Radiosity>
Rgb mean(std::span<const Ray> row, const Radiosity& radiosity) {
  Rgb sum;
  for (const Ray& ray : row) sum += radiosity(ray);
  return sum / static_cast<double>(row.size());
}

/// As HemisphereGather::gather_with_error() has it.
template <typename Ray, typename Radiosity>
Gathered mean_with_error(std::span<const Ray> row, const Radiosity& radiosity) {
  thread_local std::vector<double> values;
  values.clear();
  Gathered gathered;
  for (const Ray& ray : row) {
    const Rgb b = radiosity(ray);
    gathered.irradiance += b;
    values.push_back(luminance(b));
  }
  const auto n = static_cast<double>(row.size());
  gathered.irradiance = gathered.irradiance / n;
  const int grid = static_cast<int>(std::lround(std::sqrt(n)));
  gathered.error = std::sqrt((grid < 3 ? variance(values) : variance_in_cells(values, grid)) / n);
  return gathered;
}

}  // namespace

HemisphereGather::HemisphereGather(const RayCaster& rays, const Triangulation& mesh,
                                   std::span<const std::uint8_t> separate)
    : rays_(rays), lookup_(mesh) {
  const Scene& scene = rays.scene();
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Rgb reflectance = scene.material_of(i).reflectance;
    const Rgb emission = separate[i] ? Rgb{} : scene.objects[i].exitance;
    surfaces_.push_back({reflectance, emission});
    surfaces_.push_back({reflectance, {}});
    surfaces_.push_back({{}, emission});
  }
  surfaces_.resize(surface_count(scene));
}

Landing HemisphereGather::land(const Ray& ray) const {
  const Landing outside{{static_cast<std::uint32_t>(surfaces_.size() - 1), {}}};
  const Landing black{{outside.site.surface - 1, {}}};
  const std::optional<SurfaceHit> hit = rays_.nearest(ray);
  if (!hit) return outside;
  if (dot(hit->normal, ray.direction) >= 0) return black;
  const std::uint32_t surface = 3 * hit->surface.object;
  const std::optional<MeshPlace> place = lookup_.place(hit->point, hit->normal);
  if (!place) return hit->back ? black : Landing{{surface + 2, {}}};
  Landing landing{{surface + hit->back, place->vertices}};
  for (std::size_t k = 0; k < 2; ++k) {
    landing.weights[k] = static_cast<std::uint16_t>(place->weights[k + 1] / kSiteWeightUnit);
  }
  return landing;
}

void HemisphereGather::trace(const Receiver& receiver, int grid, std::uint64_t seed,
                             std::uint64_t id, std::span<Landing> row) const {
  // Points this close to the rim would give rays inside the surface they start from.
  constexpr double kRim = 0.99995;
  Random random(seed, id);
  const Frame frame(receiver.normal);
  const Vec3 origin = receiver.point + receiver.normal * rays_.epsilon();
  const double turn = 2 * std::numbers::pi * random.uniform();
  std::size_t ray = 0;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const double a = 2 * (i + random.uniform()) / grid - 1;
      const double b = 2 * (j + random.uniform()) / grid - 1;
      const Polar p = concentric(a * kRim, b * kRim);
      const Vec3 local{p.radius * std::cos(p.angle + turn), p.radius * std::sin(p.angle + turn),
                       std::sqrt(1 - p.radius * p.radius)};
      row[ray++] = land({origin, frame.to_world(local)});
    }
  }
}

std::vector<Landing> HemisphereGather::trace(std::span<const Receiver> receivers,
                                             std::span<const std::uint32_t> ids, int grid,
                                             std::uint64_t seed) const {
  constexpr std::size_t kGrain = 16;
  const auto cells = static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid);
  std::vector<Landing> rows(receivers.size() * cells);
  parallel_for(receivers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      trace(receivers[i], grid, seed, ids[i], std::span(rows).subspan(i * cells, cells));
    }
  });
  return rows;
}

SiteLight HemisphereGather::light_of(const Site& site, std::span<const Rgb> irradiance) const {
  const Surface& surface = surfaces_[site.surface];
  const auto narrow = [](const Rgb& c) {
    return std::array{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  };
  const auto& [a, b, c] = site.vertices;
  return {narrow(surface.emission + surface.reflectance * irradiance[a]),
          narrow(surface.reflectance * (irradiance[b] - irradiance[a])),
          narrow(surface.reflectance * (irradiance[c] - irradiance[a]))};
}

Rgb HemisphereGather::reflected(std::span<const Landing> row,
                                std::span<const Rgb> irradiance) const {
  return mean(row, [&](const Landing& landing) {
    return light_of(landing.site, irradiance).at(landing.weights) -
           surfaces_[landing.site.surface].emission;
  });
}

Rgb HemisphereGather::gather(std::span<const Landing> row, std::span<const Rgb> irradiance) const {
  return mean(row, [&](const Landing& landing) {
    return light_of(landing.site, irradiance).at(landing.weights);
  });
}

Gathered HemisphereGather::gather_with_error(std::span<const Landing> row,
                                             std::span<const Rgb> irradiance) const {
  return mean_with_error(row, [&](const Landing& landing) {
    return light_of(landing.site, irradiance).at(landing.weights);
  });
}

Rgb gather(std::span<const Link> row, std::span<const SiteLight> sites) {
  return mean(row, [&](const Link& link) { return sites[link.site].at(link.weights); });
}

Gathered gather_with_error(std::span<const Link> row, std::span<const SiteLight> sites) {
  return mean_with_error(row, [&](const Link& link) { return sites[link.site].at(link.weights); });
}

}  // namespace isolux
