#include "path_tracer.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "isolux/core/random.h"

namespace isolux {
namespace {

constexpr int kSide = 4;
constexpr std::size_t kPaths = kSide * kSide;

/// 0 … kPaths − 1 in random order.
void shuffle(std::array<std::uint8_t, kPaths>& order, Random& random) {
  for (std::size_t i = 0; i < kPaths; ++i) order[i] = static_cast<std::uint8_t>(i);
  for (std::size_t i = kPaths - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
}

}  // namespace

struct PathTracer::Batch {
  Random random;
  std::vector<Path> paths;
  std::array<double, kPaths> sums;
  // Strata of the first points on the lights, and of the choice among the lights, by path.
  std::array<std::uint8_t, kPaths> strata, choices;
  bool first = true;
  // Of the shadow rays of a bounce.
  std::vector<Segment> segments;
  std::vector<std::uint8_t> blocked;
  std::vector<std::size_t> owner;
  std::vector<double> carried;
};

PathTracer::PathTracer(const RayCaster& rays) : rays_(rays) {
  const Scene& scene = rays.scene();
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    reflectance_.push_back(luminance(scene.material_of(i).reflectance));
    if (!object.emits()) continue;
    const auto soup = object.shape->triangulate(object.shape->bounds().diagonal());
    if (!soup) continue;
    for (const auto& [a, b, c] : soup->triangles) {
      const Vec3 u = soup->points[b] - soup->points[a], v = soup->points[c] - soup->points[a];
      const Vec3 n = cross(u, v);
      flux_ += luminance(object.exitance) * length(n) / 2;
      lights_.push_back({soup->points[a], u, v, normalized(n), flux_});
    }
  }
  for (LightTriangle& light : lights_) light.upto /= flux_;
}

Vec3 PathTracer::light_point(double choice, double a, double b,
                             const LightTriangle*& triangle) const {
  const auto chosen = std::find_if(lights_.begin(), lights_.end() - 1,
                                   [&](const LightTriangle& t) { return choice < t.upto; });
  triangle = &*chosen;
  const double r = std::sqrt(a);
  return chosen->corner + chosen->u * (r * (1 - b)) + chosen->v * (r * b);
}

void PathTracer::look_for_lights(Batch& batch) const {
  shuffle(batch.choices, batch.random);
  for (std::size_t i = 0; i < batch.paths.size(); ++i) {
    const Path& path = batch.paths[i];
    if (path.throughput == 0) continue;
    double a = batch.random.uniform(), b = batch.random.uniform();
    if (batch.first) {
      a = (batch.strata[i] % kSide + a) / kSide;
      b = (batch.strata[i] / kSide + b) / kSide;
    }
    const LightTriangle* light = nullptr;
    const double choice = (batch.choices[i] + batch.random.uniform()) / kPaths;
    const Vec3 to = light_point(choice, a, b, light);
    const Vec3 from = path.at.point + path.at.normal * rays_.epsilon();
    const Vec3 d = to - from;
    const double cosines = dot(d, path.at.normal) * -dot(d, light->normal);
    if (dot(d, path.at.normal) <= 0 || dot(d, light->normal) >= 0) continue;
    const double squared = length_squared(d);
    batch.segments.push_back({from, to + light->normal * rays_.epsilon()});
    batch.owner.push_back(i);
    batch.carried.push_back(path.throughput * flux_ * cosines /
                            (std::numbers::pi * squared * squared));
  }
}

void PathTracer::look_for_sources(Batch& batch) const {
  const Scene& scene = rays_.scene();
  const double beyond = 2 * scene.bounds().diagonal();
  for (std::size_t i = 0; i < batch.paths.size(); ++i) {
    const auto& [at, throughput] = batch.paths[i];
    if (throughput == 0) continue;
    const Vec3 from = at.point + at.normal * rays_.epsilon();
    for (const Source& source : scene.sources) {
      const bool sun = source.kind == Source::Kind::directional;
      const Vec3 to = sun ? from - source.direction * beyond : source.position;
      const Vec3 way = normalized(to - from);
      const double part = sun ? 1 : source.beam(-way) / length_squared(to - from);
      const double cosine = dot(way, at.normal);
      if (!(cosine > 0 && part > 0)) continue;
      batch.segments.push_back({from, to});
      batch.owner.push_back(i);
      batch.carried.push_back(throughput * luminance(source.intensity) * part * cosine);
    }
  }
}

void PathTracer::next_event(Batch& batch) const {
  batch.segments.clear(), batch.owner.clear(), batch.carried.clear();
  if (!lights_.empty()) look_for_lights(batch);
  look_for_sources(batch);
  batch.blocked.resize(batch.segments.size());
  rays_.occluded(batch.segments, batch.blocked);
  for (std::size_t k = 0; k < batch.segments.size(); ++k) {
    if (!batch.blocked[k]) batch.sums[batch.owner[k]] += batch.carried[k];
  }
}

double PathTracer::batch_mean(const Receiver& receiver, Batch& batch) const {
  const std::optional<Sky>& sky = rays_.scene().sky;
  constexpr int kSureBounces = 2;
  batch.paths.assign(kPaths, {receiver, 1});
  batch.sums.fill(0);
  shuffle(batch.strata, batch.random);
  batch.first = true;
  std::size_t alive = kPaths;
  for (int bounce = 0; alive > 0; ++bounce) {
    next_event(batch);
    alive = 0;
    for (std::size_t i = 0; i < kPaths; ++i) {
      Path& path = batch.paths[i];
      if (path.throughput == 0) continue;
      double a = batch.random.uniform(), b = batch.random.uniform();
      if (batch.first) {
        a = (static_cast<double>(i % kSide) + a) / kSide;
        b = (static_cast<double>(i / kSide) + b) / kSide;
      }
      const double r = std::sqrt(a), phi = 2 * std::numbers::pi * b;
      const Vec3 direction =
          Frame(path.at.normal).to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - a)});
      const auto hit = rays_.nearest({path.at.point + path.at.normal * rays_.epsilon(), direction});
      if (!hit && sky) {
        batch.sums[i] += path.throughput * std::numbers::pi * luminance(sky->luminance(direction));
      }
      path.throughput *=
          hit && dot(hit->normal, direction) < 0 ? reflectance_[hit->surface.object] : 0;
      if (path.throughput == 0) continue;
      if (bounce >= kSureBounces) {
        const double survival = reflectance_[hit->surface.object];
        path.throughput = batch.random.uniform() < survival ? path.throughput / survival : 0;
        if (path.throughput == 0) continue;
      }
      path.at = {hit->point, hit->normal};
      ++alive;
    }
    batch.first = false;
  }
  double sum = 0;
  for (const double s : batch.sums) sum += s;
  return sum / static_cast<double>(kPaths);
}

TracedIrradiance PathTracer::irradiance(const Receiver& receiver, double relative, double absolute,
                                        std::uint64_t most_paths, std::uint64_t seed,
                                        std::uint64_t id) const {
  constexpr double kLeastBatches = 32;
  // A sky may show through a small opening: that nothing was met of it yet does not mean much.
  const double least_blind = rays_.scene().sky ? 4096 : kLeastBatches;
  Batch batch{Random(seed, id), {}, {}, {}, {}, true, {}, {}, {}, {}};
  TracedIrradiance traced;
  double sum = 0, squares = 0;
  for (double n = 1;; ++n) {
    const double mean = batch_mean(receiver, batch);
    sum += mean, squares += mean * mean;
    traced.paths += kPaths;
    if (n < kLeastBatches) continue;
    traced.irradiance = sum / n;
    if (sum == 0 && n < least_blind && traced.paths + kPaths <= most_paths) continue;
    traced.standard_error = std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 1) / n);
    if (traced.standard_error <= std::max(relative * traced.irradiance, absolute) ||
        traced.paths + kPaths > most_paths) {
      return traced;
    }
  }
}

}  // namespace isolux
