#include "isolux/discretization/light_reach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/sampling/lines.h"

namespace isolux {
namespace {

using Index = std::uint32_t;

constexpr std::size_t kLinesThroughLight = 64;
constexpr std::size_t kPlacesOfObject = 8;  // of lights, and of what they light
// Light is sent out along so many paths, and followed over so many reflections.
constexpr std::size_t kLeastPaths = 1024, kPathsOfLight = 4;
constexpr int kReflections = 12;
// How often light is looked for from a point, straight and by reflections.
constexpr int kStraightLooks = 24;
constexpr int kPathsBack = 12, kPathsBackToSky = 192;
// A second point of the surface is this part of the scene's diagonal away from the first.
constexpr double kAside = 1e-3;
constexpr int kSides = 4;

/// With a density proportional to the cosine from the normal.
Vec3 diffuse_direction(const Vec3& normal, Random& random) {
  const Frame frame(normal);
  const double r2 = random.uniform(), angle = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(r2);
  return frame.to_world({r * std::cos(angle), r * std::sin(angle), std::sqrt(1 - r2)});
}

}  // namespace

LightReach::LightReach(const SurfaceWalk& walk, std::uint64_t seed)
    : rays_(walk.rays()), walk_(walk), diagonal_(rays_.scene().bounds().diagonal()) {
  find_lights(seed);
  send_light(seed);
}

LightReach::Place LightReach::above(const Vec3& position, const Vec3& normal) const {
  return {position + normal * (2 * rays_.epsilon()), normal};
}

void LightReach::find_lights(std::uint64_t seed) {
  const Scene& scene = rays_.scene();
  std::vector<SurfaceHit> hits;
  for (Index i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].emits() || scene.objects[i].glows) continue;
    Random random(seed, i);
    const Bounds bounds = scene.objects[i].shape->bounds();
    const double radius = 0.5 * bounds.diagonal();
    std::vector<Place> places;
    for (std::size_t k = 0; k < kLinesThroughLight && places.size() < kPlacesOfObject; ++k) {
      const Line line = random_line(bounds.center(), radius, random);
      rays_.all_hits({line.point - line.direction * (1.01 * radius), line.direction}, {}, hits);
      for (const SurfaceHit& hit : hits) {
        if (hit.surface.object != i || hit.back) continue;
        if (walk_.at(hit)) places.push_back(above(hit.point, hit.normal));
      }
    }
    if (!places.empty()) lights_.push_back(std::move(places));
  }
}

/// Where the light of a ray is reflected; nothing where it leaves the scene or is absorbed. The
/// object that it met is left in `object`.
std::optional<LightReach::Place> LightReach::reflected(const Ray& ray, Index& object) const {
  const auto hit = rays_.nearest(ray);
  if (!hit || dot(hit->normal, ray.direction) >= 0) return std::nullopt;
  object = hit->surface.object;
  return above(hit->point, hit->normal);
}

/// Lights, then sources, then the sky.
std::size_t LightReach::kinds() const {
  const Scene& scene = rays_.scene();
  return lights_.size() + scene.sources.size() + (scene.sky && scene.sky->shines());
}

/// Of light of that kind.
Ray LightReach::first_ray(std::size_t kind, Random& random) const {
  const Scene& scene = rays_.scene();
  const double radius = 0.5 * diagonal_;
  if (kind < lights_.size()) {
    const Place& from = lights_[kind][random.below(lights_[kind].size())];
    return {from.position, diffuse_direction(from.normal, random)};
  }
  if (kind == lights_.size() + scene.sources.size()) {
    const Line line = random_line(scene.bounds().center(), radius, random);
    return {line.point - line.direction * (2 * radius), line.direction};
  }
  const Source& source = scene.sources[kind - lights_.size()];
  if (source.kind != Source::Kind::directional) {
    return {source.position, random_line(source.position, 1, random).direction};
  }
  const Frame across(source.direction);
  const double r = radius * std::sqrt(random.uniform());
  const double angle = 2 * std::numbers::pi * random.uniform();
  const Vec3 from = across.to_world({r * std::cos(angle), r * std::sin(angle), -2 * radius});
  return {scene.bounds().center() + from, source.direction};
}

void LightReach::send_light(std::uint64_t seed) {
  const Scene& scene = rays_.scene();
  if (kinds() == 0) return;
  std::vector<std::size_t> known(scene.objects.size());
  const std::size_t paths = std::max(kLeastPaths, kPathsOfLight * kinds());
  for (std::size_t path = 0; path < paths; ++path) {
    Random random(seed, ~path);
    Ray ray = first_ray(path % kinds(), random);
    for (int i = 0; i < kReflections; ++i) {
      Index object = 0;
      const auto place = reflected(ray, object);
      if (!place) break;
      if (known[object]++ < kPlacesOfObject) lit_.push_back(*place);
      if (luminance(scene.material_of(object).reflectance) == 0) break;
      ray = {place->position, diffuse_direction(place->normal, random)};
    }
  }
}

bool LightReach::opens_to(const Place& place, const Vec3& from) const {
  return dot(from - place.position, place.normal) > 0 && !rays_.occluded({place.position, from});
}

/// Whether one light, chosen at random, lights the place.
bool LightReach::lit_straight(const Place& place, Random& random) const {
  const auto& sources = rays_.scene().sources;
  const std::size_t kind = random.below(kinds());
  if (kind < lights_.size()) {
    const Place& light = lights_[kind][random.below(lights_[kind].size())];
    return !rays_.occluded({place.position, light.position});
  }
  if (kind == lights_.size() + sources.size()) {
    return !rays_.nearest({place.position, diffuse_direction(place.normal, random)});
  }
  const Source& source = sources[kind - lights_.size()];
  if (source.kind != Source::Kind::directional) return opens_to(place, source.position);
  return opens_to(place, place.position - source.direction * (2 * diagonal_));
}

bool LightReach::sees_lit_place(const Place& place, Random& random) const {
  if (lit_.empty()) return false;
  return !rays_.occluded({place.position, lit_[random.below(lit_.size())].position});
}

bool LightReach::sees_light(const SurfacePoint& point, Random& random) const {
  if (kinds() == 0) return true;
  const Place start = above(point.position, point.normal);
  const auto& cameras = rays_.scene().cameras;
  if (std::any_of(cameras.begin(), cameras.end(),
                  [&](const Camera& camera) { return opens_to(start, camera.eye); })) {
    return true;
  }
  for (int i = 0; i < kStraightLooks; ++i) {
    if (lit_straight(start, random) || sees_lit_place(start, random)) return true;
  }
  return false;
}

bool LightReach::is_on_path_of_light(const SurfacePoint& point, Random& random) const {
  const Place start = above(point.position, point.normal);
  const int paths = rays_.scene().sky ? kPathsBackToSky : kPathsBack;
  for (int i = 0; i < paths; ++i) {
    Place place = start;
    for (int k = 0; k < kReflections; ++k) {
      Index object = 0;
      const auto next =
          reflected({place.position, diffuse_direction(place.normal, random)}, object);
      if (!next) break;
      place = *next;
      if (lit_straight(place, random) || sees_lit_place(place, random)) return true;
    }
  }
  return false;
}

std::optional<ZonePoint> LightReach::beside(const ZonePoint& point, Random& random) const {
  const Frame frame(point.normal);
  const double far = kAside * diagonal_;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * random.uniform();
    const Vec3 d = frame.u * std::cos(angle) + frame.v * std::sin(angle);
    if (auto other = walk_.step(point, point.position + d * far)) return other;
  }
  return std::nullopt;
}

}  // namespace isolux
