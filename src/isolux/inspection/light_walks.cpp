#include "isolux/inspection/light_walks.h"

#include <algorithm>
#include <numbers>

#include "isolux/core/parallel.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {

constexpr std::size_t kWalks = 8192;     // from the lights; as many from the cameras
constexpr std::size_t kLeastAtOne = 16;  // of them, at each light and camera
constexpr int kSteps = 8;

/// Where a walk begins: one of the lights (objects, then sources), or a camera.
struct Start {
  enum class Kind { object, source, camera } kind;
  std::uint32_t index;
};

/// What a walk met.
struct Trail {
  struct Meeting {
    std::uint32_t object;
    bool back;
  };
  std::vector<Meeting> meetings;
  std::uint32_t rays = 0;
  bool begun = false, first_lost = false, escaped = false;
};

Vec3 diffuse_direction(const Vec3& normal, Random& random) {
  const double r2 = random.uniform(), phi = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(r2);
  return Frame(normal).to_world({r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - r2)});
}

class Walker {
 public:
  Walker(const RayCaster& rays, std::span<const std::vector<Hit>> points)
      : rays_(rays), points_(points), bounds_(rays.scene().bounds()) {}

  Trail walk(const Start& start, Random& random) const {
    Trail trail;
    const std::optional<Ray> first = first_ray(start, random);
    if (!first) return trail;
    trail.begun = true;
    Ray ray = *first;
    for (int step = 0; step < kSteps; ++step) {
      const std::optional<SurfaceHit> hit = rays_.nearest(ray);
      ++trail.rays;
      trail.escaped = !hit;
      const bool black = hit && dot(hit->normal, ray.direction) >= 0;
      if (step == 0) trail.first_lost = black || (!hit && !rays_.scene().sky);
      if (!hit) break;
      const Object& object = rays_.scene().objects[hit->surface.object];
      trail.meetings.push_back({hit->surface.object, black || (object.emits() && hit->back)});
      if (black) break;
      ray = {hit->point + hit->normal * rays_.epsilon(), diffuse_direction(hit->normal, random)};
    }
    return trail;
  }

 private:
  std::optional<Ray> first_ray(const Start& start, Random& random) const {
    const Scene& scene = rays_.scene();
    if (start.kind == Start::Kind::camera) {
      const double x = random.uniform(), y = random.uniform();
      return scene.cameras[start.index].ray(x, y);
    }
    if (start.kind == Start::Kind::source) return first_ray(scene.sources[start.index], random);
    const std::vector<Hit>& points = points_[start.index];
    if (points.empty()) return std::nullopt;
    const Hit& from = points[random.below(points.size())];
    return Ray{from.point + from.normal * rays_.epsilon(), diffuse_direction(from.normal, random)};
  }

  /// Of a source: within its beam; or from far away, towards the scene.
  std::optional<Ray> first_ray(const Source& source, Random& random) const {
    const Frame frame(source.direction);
    const double phi = 2 * std::numbers::pi * random.uniform();
    if (source.kind == Source::Kind::directional) {
      const double r = 0.5 * bounds_.diagonal() * std::sqrt(random.uniform());
      const Vec3 across = frame.to_world({r * std::cos(phi), r * std::sin(phi), 0});
      const Ray ray{bounds_.center() + across - source.direction * bounds_.diagonal(),
                    source.direction};
      // What misses the scene was never in it.
      return rays_.nearest(ray) ? std::optional(ray) : std::nullopt;
    }
    const double z = 1 - (1 - source.cos_dark()) * random.uniform();
    const double s = std::sqrt(std::max(0.0, 1 - z * z));
    return Ray{source.position, frame.to_world({s * std::cos(phi), s * std::sin(phi), z})};
  }

  const RayCaster& rays_;
  std::span<const std::vector<Hit>> points_;
  Bounds bounds_;
};

std::vector<Start> lights_of(const Scene& scene) {
  std::vector<Start> starts;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].emits()) starts.push_back({Start::Kind::object, i});
  }
  for (std::uint32_t i = 0; i < scene.sources.size(); ++i) {
    if (max_channel(scene.sources[i].intensity) > 0) starts.push_back({Start::Kind::source, i});
  }
  return starts;
}

std::vector<Start> cameras_of(const Scene& scene) {
  std::vector<Start> starts;
  for (std::uint32_t i = 0; i < scene.cameras.size(); ++i) {
    starts.push_back({Start::Kind::camera, i});
  }
  return starts;
}

/// Walks from all starts in turn, each with its own random numbers.
void walk_all(const Walker& walker, std::span<const Start> starts, std::uint64_t seed,
              LightWalks& found) {
  if (starts.empty()) return;
  std::vector<Trail> trails(std::max(kWalks, kLeastAtOne * starts.size()));
  parallel_for(trails.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Random random(seed, i);
      trails[i] = walker.walk(starts[i % starts.size()], random);
    }
  });
  for (std::size_t i = 0; i < trails.size(); ++i) {
    const Trail& trail = trails[i];
    found.rays += trail.rays;
    found.escaped += trail.escaped;
    found.open |= trail.escaped;
    for (const auto& [object, back] : trail.meetings) {
      Sight& sight = found.sights[object];
      ++(back ? sight.back : sight.front);
    }
    const Start& start = starts[i % starts.size()];
    if (!trail.begun || start.kind == Start::Kind::camera) continue;
    const std::size_t first = start.kind == Start::Kind::source ? found.sights.size() : 0;
    Shine& shine = found.shines[first + start.index];
    shine.rays += 1;
    shine.lost += trail.first_lost;
  }
}

}  // namespace

LightWalks walk_with_light(const RayCaster& rays, std::span<const std::vector<Hit>> points) {
  const Scene& scene = rays.scene();
  LightWalks found;
  found.sights.resize(scene.objects.size());
  found.shines.resize(scene.objects.size() + scene.sources.size());
  const Walker walker(rays, points);
  walk_all(walker, cameras_of(scene), 2, found);
  // Light is asked, not eyes, for how much of it leaves; a camera may stand outside a room. That of
  // a sky comes from where it would leave to.
  const std::vector<Start> lights = lights_of(scene);
  if (!lights.empty()) found.rays = found.escaped = 0;
  walk_all(walker, lights, 3, found);
  return found;
}

}  // namespace isolux
