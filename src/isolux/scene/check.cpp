#include "isolux/scene/check.h"

#include <fmt/format.h>

#include <set>

#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

constexpr double kHighReflectance = 0.95;   ///< whiter than any paint
constexpr double kTinyLight = 1e-3;         ///< of the scene's size
constexpr double kUnlikelySizeRatio = 1e3;  ///< of the scene to all of it but one object

using Warnings = std::vector<std::string>;

void check_materials(const Scene& scene, Warnings& warnings) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const Object& object : scene.objects) used[object.material] = true;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    if (!used[i])
      warnings.push_back(fmt::format("material {} is not used", in_quotes(material.name)));
    if (max_channel(material.reflectance) > kHighReflectance) {
      warnings.push_back(fmt::format(
          "material {} reflects {}: few surfaces exceed {}, and the "
          "solution converges slowly",
          in_quotes(material.name), max_channel(material.reflectance), kHighReflectance));
    }
  }
}

void check_names(const Scene& scene, Warnings& warnings) {
  std::set<std::string_view> seen, repeated;
  for (const Object& object : scene.objects) {
    if (!seen.insert(object.name).second && repeated.insert(object.name).second) {
      warnings.push_back(fmt::format("several objects are named {}", in_quotes(object.name)));
    }
  }
}

/// Whether the front of every triangle that the light is cut into has its middle inside the solid;
/// `hair` (m) lifts it off the surface.
bool hidden_in(const Shape& light, const Shape& solid, double hair) {
  const auto soup = light.triangulate(std::numeric_limits<double>::infinity());
  return soup && std::all_of(soup->triangles.begin(), soup->triangles.end(), [&](const auto& t) {
           const Vec3 a = soup->points[t[0]], b = soup->points[t[1]], c = soup->points[t[2]];
           return solid.contains((a + b + c) / 3 + normalized(cross(b - a, c - a)) * hair);
         });
}

void check_lights(const Scene& scene, double scene_size, Warnings& warnings) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!object.emits()) continue;
    const Rgb& reflectance = scene.materials[object.material].reflectance;
    if (max_channel(reflectance) > 0) {
      warnings.push_back(
          fmt::format("light {} also reflects {}: measured fluxes usually include "
                      "that, so consider reflectance 0",
                      in_quotes(object.name), max_channel(reflectance)));
    }
    for (const Object& other : scene.objects) {
      if (&other != &object && other.shape->solid() &&
          hidden_in(*object.shape, *other.shape, 1e-6 * scene_size)) {
        warnings.push_back(fmt::format("light {} lies inside {}: its light goes nowhere",
                                       in_quotes(object.name), in_quotes(other.name)));
      }
    }
    const double size = object.shape->bounds().diagonal();
    if (size < kTinyLight * scene_size) {
      warnings.push_back(
          fmt::format("light {} is tiny, {:.3g} m in a scene of {:.3g} m: check its "
                      "unit",
                      in_quotes(object.name), size, scene_size));
    }
  }
}

/// An object that makes the scene a thousand times larger than the others do (at least two, as one
/// may well be a small lamp in a hall).
void check_sizes(const Scene& scene, double scene_size, Warnings& warnings) {
  const std::size_t count = scene.objects.size();
  if (count < 3) return;
  std::vector<Bounds> after(count + 1);
  for (std::size_t i = count; i-- > 0;) {
    after[i] = after[i + 1];
    after[i].include(scene.objects[i].shape->bounds());
  }
  Bounds others_before;
  for (std::size_t i = 0; i < count; ++i) {
    Bounds others = others_before;
    others.include(after[i + 1]);
    if (!others.empty() && scene_size > kUnlikelySizeRatio * others.diagonal()) {
      warnings.push_back(
          fmt::format("object {} is far larger or farther than all others, {:.3g} m "
                      "against {:.3g} m: check its unit",
                      in_quotes(scene.objects[i].name), scene_size, others.diagonal()));
    }
    others_before.include(scene.objects[i].shape->bounds());
  }
}

}  // namespace

SceneReport check_scene(const Scene& scene) {
  SceneReport report;
  report.name = scene.name;
  report.unit = scene.unit;
  report.materials = scene.materials.size();
  report.cameras = scene.cameras.size();
  report.bounds = scene.bounds();
  for (const Object& object : scene.objects) {
    report.objects.push_back({object.name, scene.materials[object.material].name,
                              surface_area(*object.shape), luminous_flux(object),
                              object.shape->bounds()});
    report.lights += object.emits() ? 1 : 0;
    report.flux += report.objects.back().flux;
  }
  for (const Source& source : scene.sources) {
    report.lights += 1;
    report.flux += luminous_flux(source);
  }
  if (!scene.has_light()) report.warnings.push_back("nothing gives light: everything is black");
  if (report.cameras == 0) {
    report.warnings.push_back("no camera: the scene can be solved and measured, but not rendered");
  }
  const double size = report.bounds.diagonal();
  check_materials(scene, report.warnings);
  check_names(scene, report.warnings);
  check_lights(scene, size, report.warnings);
  check_sizes(scene, size, report.warnings);
  return report;
}

}  // namespace isolux
