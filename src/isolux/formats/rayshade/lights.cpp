#include "isolux/formats/rayshade/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "isolux/geometry/disk.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/sphere.h"

namespace isolux::rayshade {
namespace {

using std::numbers::pi;

constexpr double kPointRadius = 1.0 / 200;  ///< of the scene's size
constexpr double kFar = 10;                 ///< of the scene's size, to directional lights
constexpr double kFarRadius = 0.5;          ///< of the scene's size: 2.9° at that distance
constexpr double kLargestExitance = 1e12;   ///< lm/m²

struct Lamp {
  const char* kind;
  std::shared_ptr<const Shape> shape;
  double gain;  ///< exitance for each lx at the middle of the scene
};

/// The radius that a small sphere may have there without touching anything, as far as is known.
double free_radius(const Vec3& center, double wanted, const Scene& scene) {
  double radius = wanted;
  for (int halvings = 0; halvings < 8; ++halvings, radius *= 0.5) {
    const Vec3 half = Vec3{1, 1, 1} * radius;
    const Bounds box{center - half, center + half};
    const bool free = std::all_of(scene.objects.begin(), scene.objects.end(),
                                  [&](const Object& o) { return o.shape->avoids(box); });
    if (free) return radius;
  }
  return wanted;
}

/// A sphere or disk of radius r and exitance M sends M r² / d² to the distance d.
double round_gain(double distance, double radius) {
  return distance * distance / (radius * radius);
}

Lamp lamp_for(const Light& light, const Extent& extent, const Scene& scene) {
  const double small = kPointRadius * extent.size;
  double away = distance(light.position, extent.middle);
  switch (light.kind) {
    case Light::Kind::point: {
      const double radius = free_radius(light.position, small, scene);
      away = std::max(away, radius);
      return {"point light", std::make_shared<Sphere>(light.position, radius),
              round_gain(away, radius)};
    }
    case Light::Kind::extended:
      away = std::max(away, light.radius);
      return {"extended light", std::make_shared<Sphere>(light.position, light.radius),
              round_gain(away, light.radius)};
    case Light::Kind::spot: {
      const double radius = free_radius(light.position, small, scene);
      away = std::max(away, radius);
      return {"spot light", std::make_shared<Disk>(light.position, light.direction, radius),
              round_gain(away, radius)};
    }
    case Light::Kind::area: {
      const Vec3 middle = light.position + (light.u + light.v) * 0.5;
      const Vec3 normal = cross(light.u, light.v);
      const bool faces = dot(normal, extent.middle - middle) >= 0;
      away = distance(middle, extent.middle);
      return {"area light",
              std::make_shared<Parallelogram>(light.position, faces ? light.u : light.v,
                                              faces ? light.v : light.u),
              std::max(1.0, pi * away * away / length(normal))};
    }
    case Light::Kind::directional:
      break;
  }
  const Vec3 direction = normalized(light.direction);
  const double radius = kFarRadius * extent.size;
  away = kFar * extent.size;
  return {"directional light",
          std::make_shared<Disk>(extent.middle + direction * away, -direction, radius),
          1 + round_gain(away, radius)};  // 1 / sin² of its half angle
}

void note(const Light& light, Notes& notes) {
  switch (light.kind) {
    case Light::Kind::point:
      notes.add(fmt::format("point lights are small spheres, {} of the scene's size in radius",
                            kPointRadius));
      break;
    case Light::Kind::spot:
      notes.add("spot lights are small disks that shine by the cosine, whatever their cone");
      break;
    case Light::Kind::directional:
      notes.add(fmt::format("directional lights are disks at {} times the scene's size", kFar));
      break;
    case Light::Kind::area:
      notes.add("area lights shine from the side that faces the scene's middle");
      break;
    case Light::Kind::extended:
      break;
  }
}

}  // namespace

void add_lights(const std::vector<Light>& lights, const Extent& extent, Scene& scene,
                Notes& notes) {
  const auto material = static_cast<std::uint32_t>(scene.materials.size());
  std::vector<Object> lamps;
  for (const Light& light : lights) {
    if (max_channel(light.intensity) == 0) continue;
    const Lamp lamp = lamp_for(light, extent, scene);
    note(light, notes);
    const std::string name = fmt::format("{} {}", lamp.kind, lamps.size() + 1);
    const Rgb exitance = light.intensity * (pi * lamp.gain);
    if (!(max_channel(exitance) <= kLargestExitance)) {
      fail(light.place,
           "this light is too bright for its size: more than 1e12 lm/m2 would leave it");
    }
    const Sides sides = lamp.shape->solid() ? Sides::front : Sides::both;
    lamps.push_back({name, lamp.shape, material, sides, exitance});
  }
  if (lamps.empty()) return;
  scene.materials.push_back({"light", {}});
  std::move(lamps.begin(), lamps.end(), std::back_inserter(scene.objects));
  notes.add(
      "a light of intensity 1 gives pi lx at the scene's middle, by which a surface there looks "
      "as bright as its 'diffuse' color; unlike in Rayshade it fades with the distance");
}

}  // namespace isolux::rayshade
