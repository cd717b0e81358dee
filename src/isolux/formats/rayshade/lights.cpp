#include "isolux/formats/rayshade/lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "isolux/formats/limits.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/sphere.h"

namespace isolux::rayshade {
namespace {

using std::numbers::pi;

constexpr double kNearest = 1e-3;  ///< of the scene's size: a light in its middle

/// What stands for a light with a surface: its shape, and its exitance for each lx at the middle of
/// the scene.
struct Lamp {
  std::shared_ptr<const Shape> shape;
  double gain;
};

Lamp extended_light(const Light& light, const Extent& extent) {
  const double away = std::max(distance(light.position, extent.middle), light.radius);
  // A sphere of radius r and exitance M sends M r² / d² to the distance d.
  return {std::make_shared<Sphere>(light.position, light.radius),
          away * away / (light.radius * light.radius)};
}

Lamp area_light(const Light& light, const Extent& extent) {
  const Vec3 middle = light.position + (light.u + light.v) * 0.5;
  const Vec3 normal = cross(light.u, light.v);
  const bool faces = dot(normal, extent.middle - middle) >= 0;
  const double away = distance(middle, extent.middle);
  return {std::make_shared<Parallelogram>(light.position, faces ? light.u : light.v,
                                          faces ? light.v : light.u),
          std::max(1.0, pi * away * away / length(normal))};
}

Source source_of(const Light& light, const Extent& extent) {
  Source source;
  if (light.kind == Light::Kind::directional) {
    source.kind = Source::Kind::directional;
    source.direction = -normalized(light.direction);
    source.intensity = light.intensity * pi;
    return source;
  }
  source.position = light.position;
  const double away = std::max(distance(light.position, extent.middle), kNearest * extent.size);
  source.intensity = light.intensity * (pi * away * away);
  if (light.kind == Light::Kind::spot) {
    source.direction = normalized(light.direction);
    source.full_angle = light.full_angle;
    source.dark_angle = light.dark_angle;
  }
  return source;
}

const char* name_of(Light::Kind kind) {
  switch (kind) {
    case Light::Kind::point:
      return "point light";
    case Light::Kind::directional:
      return "directional light";
    case Light::Kind::extended:
      return "extended light";
    case Light::Kind::spot:
      return "spot light";
    case Light::Kind::area:
      return "area light";
  }
  return "";
}

}  // namespace

void add_lights(const std::vector<Light>& lights, const Extent& extent, Scene& scene,
                Notes& notes) {
  const auto material = static_cast<std::uint32_t>(scene.materials.size());
  std::size_t number = 0;
  for (const Light& light : lights) {
    if (max_channel(light.intensity) == 0) continue;
    const std::string name = fmt::format("{} {}", name_of(light.kind), ++number);
    if (light.kind != Light::Kind::extended && light.kind != Light::Kind::area) {
      scene.sources.push_back(source_of(light, extent));
      scene.sources.back().name = name;
      continue;
    }
    const bool area = light.kind == Light::Kind::area;
    if (area) notes.add("area lights shine from the side that faces the scene's middle");
    const auto [shape, gain] = area ? area_light(light, extent) : extended_light(light, extent);
    const Rgb exitance = light.intensity * (pi * gain);
    if (!(max_channel(exitance) <= kMostExitance)) {
      fail(light.place,
           "this light is too bright for its size: more than 1e12 lm/m2 would leave it");
    }
    if (scene.materials.size() == material) scene.materials.push_back({"light", {}});
    const Sides sides = shape->solid() ? Sides::front : Sides::both;
    scene.objects.push_back({name, shape, material, sides, exitance});
  }
  if (number == 0) return;
  notes.add(
      "a light of intensity 1 gives pi lx at the scene's middle, by which a surface there looks "
      "as bright as its 'diffuse' color; unlike in Rayshade it fades with the distance");
}

}  // namespace isolux::rayshade
