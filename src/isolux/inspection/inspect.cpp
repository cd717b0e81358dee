#include "isolux/inspection/inspect.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/inspection/contact.h"
#include "isolux/inspection/light_walks.h"
#include "isolux/inspection/surface_points.h"
#include "isolux/scene/check.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

using Warnings = std::vector<std::string>;
using Index = std::uint32_t;

constexpr double kNoArea = 1e-12;     // of the scene's diagonal squared
constexpr double kMostly = 0.9;       // of the rays that meet an object, or leave a light
constexpr std::uint32_t kEnough = 8;  // rays to judge by

std::string quoted(const Scene& scene, Index i) { return in_quotes(scene.objects[i].name); }

void warn_of_areas(const Scene& scene, std::span<const std::vector<Hit>> points,
                   Warnings& warnings) {
  Warnings empty, small;
  const double diagonal = scene.bounds().diagonal();
  for (Index i = 0; i < points.size(); ++i) {
    const std::optional<double> area = scene.objects[i].shape->area();
    if (points[i].empty()) {
      empty.push_back(fmt::format("no ray meets {}: nothing is left of it", quoted(scene, i)));
    } else if (area && *area < kNoArea * diagonal * diagonal) {
      small.push_back(fmt::format("{} has next to no area, {:.2g} m²", quoted(scene, i), *area));
    }
  }
  add_some(warnings, empty);
  add_some(warnings, small);
}

/// What is met mostly from the side that takes no part (lights: that does not shine).
void warn_of_backs(const Scene& scene, std::span<const Sight> sights, Warnings& warnings) {
  Warnings inverted;
  for (Index i = 0; i < sights.size(); ++i) {
    const auto& [front, back] = sights[i];
    if (front + back < kEnough || back < kMostly * (front + back)) continue;
    const Object& object = scene.objects[i];
    const char* remedy = object.emits() ? "it shines the other way; turn it over?"
                         : object.shape->solid()
                             ? "it is a solid around the scene; a room is its complement"
                             : "that side is black; turn it over, or let it have both sides?";
    inverted.push_back(
        fmt::format("{} is seen from behind by {:.0f} % of the rays that meet it: {}",
                    quoted(scene, i), 100.0 * back / (front + back), remedy));
  }
  add_some(warnings, inverted);
}

/// Lights that are `buried` are named elsewhere.
void warn_of_lost_light(const Scene& scene, std::span<const Shine> shines,
                        std::span<const ObjectPair> buried, Warnings& warnings) {
  Warnings lost;
  for (Index i = 0; i < shines.size(); ++i) {
    const bool source = i >= scene.objects.size();
    const std::string& name =
        source ? scene.sources[i - scene.objects.size()].name : scene.objects[i].name;
    if (shines[i].rays < kEnough || shines[i].lost < shines[i].rays) continue;
    if (std::any_of(buried.begin(), buried.end(), [&](const auto& p) { return p.first == i; }))
      continue;
    lost.push_back(
        fmt::format("light {} shines at nothing: all its rays leave the scene or end on black "
                    "backs",
                    in_quotes(name)));
  }
  add_some(warnings, lost);
}

void warn_of_contacts(const Scene& scene, const Contacts& contacts, Warnings& warnings) {
  const auto warn = [&](const std::vector<ObjectPair>& pairs, const char* text) {
    Warnings alike;
    for (const auto& [first, second] : pairs) {
      alike.push_back(fmt::format(fmt::runtime(text), quoted(scene, first), quoted(scene, second)));
    }
    add_some(warnings, alike);
  };
  warn(contacts.hidden, "{} coincides with {}, which comes later in the scene and hides it");
  warn(contacts.overlapping,
       "{} and {} overlap in one surface: there, the later in the scene is seen");
  warn(contacts.crossing, "{} and {} run through each other");
  Warnings buried;
  for (const auto& [inner, outer] : contacts.buried) {
    buried.push_back(fmt::format(
        "{}{} lies inside {}: {}", scene.objects[inner].emits() ? "light " : "",
        quoted(scene, inner), quoted(scene, outer),
        scene.objects[inner].emits() ? "its light goes nowhere" : "light never gets there"));
  }
  add_some(warnings, buried);
}

}  // namespace

Inspection inspect_scene(const RayCaster& rays) {
  const Scene& scene = rays.scene();
  const std::vector<std::vector<Hit>> points = points_on_objects(scene);
  const LightWalks walks = walk_with_light(rays, points);
  Inspection inspection;
  inspection.rays = walks.rays;
  inspection.escaped = walks.escaped;
  warn_of_areas(scene, points, inspection.warnings);
  warn_of_backs(scene, walks.sights, inspection.warnings);
  const Contacts contacts = find_contacts(rays, points);
  warn_of_lost_light(scene, walks.shines, contacts.buried, inspection.warnings);
  if (scene.sky && scene.sky->shines() && walks.rays > 0 && !walks.open) {
    inspection.warnings.push_back("no ray leaves the scene: the sky gives it no light");
  }
  warn_of_contacts(scene, contacts, inspection.warnings);
  return inspection;
}

}  // namespace isolux
