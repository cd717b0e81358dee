#include "isolux/scene/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "isolux/geometry/instance.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

constexpr double kHighReflectance = 0.95;   ///< whiter than any paint
constexpr double kTinyLight = 1e-3;         ///< of the scene's size
constexpr double kUnlikelySizeRatio = 1e3;  ///< of the scene to all of it but one object

using Warnings = std::vector<std::string>;

void check_materials(const Scene& scene, Warnings& warnings) {
  Warnings unused, bright;
  std::vector<bool> used(scene.materials.size(), false);
  for (const Object& object : scene.objects) used[object.material] = true;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    if (!used[i])
      unused.push_back(fmt::format("material {} is not used", in_quotes(material.name)));
    if (max_channel(material.reflectance) > kHighReflectance) {
      bright.push_back(fmt::format(
          "material {} reflects {}: few surfaces exceed {}, and the solution converges "
          "slowly",
          in_quotes(material.name), max_channel(material.reflectance), kHighReflectance));
    }
  }
  add_some(warnings, unused);
  add_some(warnings, bright);
}

void check_names(const Scene& scene, Warnings& warnings) {
  Warnings several;
  std::set<std::string_view> seen, repeated;
  for (const Object& object : scene.objects) {
    if (!seen.insert(object.name).second && repeated.insert(object.name).second) {
      several.push_back(fmt::format("several objects are named {}", in_quotes(object.name)));
    }
  }
  add_some(warnings, several);
}

void check_lights(const Scene& scene, double scene_size, Warnings& warnings) {
  Warnings reflecting, tiny;
  for (const Object& object : scene.objects) {
    if (!object.emits()) continue;
    const Rgb& reflectance = scene.materials[object.material].reflectance;
    if (max_channel(reflectance) > 0) {
      reflecting.push_back(
          fmt::format("light {} also reflects {}: measured fluxes usually include that, so "
                      "consider reflectance 0",
                      in_quotes(object.name), max_channel(reflectance)));
    }
    const double size = object.shape->bounds().diagonal();
    if (size < kTinyLight * scene_size) {
      tiny.push_back(
          fmt::format("light {} is tiny, {:.3g} m in a scene of {:.3g} m: check its unit",
                      in_quotes(object.name), size, scene_size));
    }
  }
  add_some(warnings, reflecting);
  add_some(warnings, tiny);
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

using Counts = std::map<std::string, std::size_t>;

/// The primitives that shapes are made of; a shape that stands in many places is asked once.
class Primitives {
 public:
  const Counts& of(const std::shared_ptr<const Shape>& shape) {
    const std::shared_ptr<const Shape> first = original(shape).shape;
    const auto [known, is_new] = known_.try_emplace(first.get());
    Counts& counts = known->second;  // stays where it is
    if (!is_new) return counts;
    const ShapeDescription description = first->describe();
    if (description.operands.empty()) counts[std::string(description.kind)] = 1;
    for (const auto& operand : description.operands) add(of(operand), counts);
    return counts;
  }

  static void add(const Counts& some, Counts& all) {
    for (const auto& [kind, count] : some) all[kind] += count;
  }

 private:
  std::unordered_map<const Shape*, Counts> known_;
};

}  // namespace

void add_some(std::vector<std::string>& warnings, const std::vector<std::string>& alike) {
  constexpr std::size_t kSome = 3;
  const std::size_t some = std::min(kSome, alike.size());
  warnings.insert(warnings.end(), alike.begin(), alike.begin() + std::ptrdiff_t(some));
  if (alike.size() > some) {
    warnings.push_back(fmt::format("and {} more like that", alike.size() - some));
  }
}

SkyReport report_sky(const Sky& sky) {
  return {luminance(horizontal_illuminance(sky)), luminance(sky.ground)};
}

SceneReport check_scene(const Scene& scene, std::size_t listed) {
  SceneReport report;
  report.name = scene.name;
  report.unit = scene.unit;
  report.object_count = scene.objects.size();
  report.materials = scene.materials.size();
  report.cameras = scene.cameras.size();
  report.bounds = scene.bounds();
  Primitives primitives;
  for (const Object& object : scene.objects) {
    const double flux = luminous_flux(object);
    if (report.objects.size() < listed) {
      report.objects.push_back({object.name, scene.materials[object.material].name,
                                surface_area(*object.shape), flux, object.shape->bounds()});
    }
    report.lights += object.emits() ? 1 : 0;
    report.flux += flux;
    Primitives::add(primitives.of(object.shape), report.primitives);
  }
  for (const Source& source : scene.sources) {
    report.lights += 1;
    report.flux += luminous_flux(source);
  }
  if (scene.sky) {
    report.lights += scene.sky->shines() ? 1 : 0;
    report.sky = report_sky(*scene.sky);
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
