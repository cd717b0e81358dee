#include "isolux/formats/assembly.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/core/error.h"
#include "isolux/formats/default_camera.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/soup.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/instance.h"

namespace isolux {
namespace {

constexpr std::size_t kMostItems = 2'000'000;          // points and triangles of all meshes
constexpr std::size_t kMostBeforeMending = 2'000'000;  // of a mesh, before it is mended
constexpr double kRoom = 0.5;  // of the scene's size: a room is that large at least
constexpr std::size_t kMostWitnesses = 64;

Rgb clamped(const Rgb& c, double least, double most) {
  return {std::clamp(c.r, least, most), std::clamp(c.g, least, most), std::clamp(c.b, least, most)};
}

/// Places that a room has inside: eyes, sources and a point in front of each light.
std::vector<Vec3> witnesses(const Scene& scene, double hair) {
  std::vector<Vec3> places;
  for (const Camera& camera : scene.cameras) places.push_back(camera.eye);
  for (const Source& source : scene.sources) {
    if (source.kind == Source::Kind::point) places.push_back(source.position);
  }
  for (const Object& object : scene.objects) {
    if (!object.emits() || places.size() > kMostWitnesses) continue;
    const auto soup = object.shape->triangulate(std::numeric_limits<double>::infinity());
    if (!soup || soup->triangles.empty()) continue;
    const auto& [a, b, c] = soup->triangles.front();
    const Vec3 &p = soup->points[a], &q = soup->points[b], &r = soup->points[c];
    places.push_back((p + q + r) / 3 + normalized(cross(q - p, r - p)) * hair);
  }
  if (places.size() > kMostWitnesses) places.resize(kMostWitnesses);
  return places;
}

}  // namespace

void Assembly::count_items(std::size_t items) {
  items_ += items;
  if (items_ <= kMostItems) return;
  throw InputError(
      fmt::format("the scene has more than {} points and triangles: make it coarser", kMostItems));
}

std::shared_ptr<const Shape> Assembly::mesh(TriangleSoup soup, bool two_sided) {
  if (soup.triangles.size() > kMostBeforeMending) {
    throw InputError(
        fmt::format("a mesh has more than {} triangles: make it coarser", kMostBeforeMending));
  }
  const LeftOut left_out = weld(soup);
  flat_ += left_out.flat;
  repeated_ += left_out.repeated;
  if (soup.triangles.empty()) return nullptr;
  count_items(soup.points.size() + soup.triangles.size());
  return mesh_of(std::move(soup), two_sided);
}

std::shared_ptr<const Shape> Assembly::placed(const std::shared_ptr<const Shape>& mesh,
                                              const Affine& map) {
  return std::make_shared<Instance>(mesh, map);
}

std::uint32_t Assembly::material(const Look& look) {
  const auto number = static_cast<std::uint32_t>(scene_.materials.size());
  const std::string name = clean_name(look.material, "unnamed");
  const Rgb& c = look.reflectance;
  const auto [found, is_new] = materials_.try_emplace({name, c.r, c.g, c.b}, number);
  if (is_new) {
    const Rgb reflectance = clamped(c, 0, kMostReflectance);
    clamped_ += reflectance != c;
    scene_.materials.push_back({material_names_.next(name), reflectance});
  }
  return found->second;
}

void Assembly::add(const std::string& name, std::shared_ptr<const Shape> shape, const Look& look) {
  if (!shape) return;
  if (scene_.objects.size() == kMostObjects) {
    throw InputError(fmt::format("the scene has more than {} objects", kMostObjects));
  }
  if (!is_finite(look.reflectance)) throw InputError("a reflectance is not finite");
  if (!is_finite(look.exitance) || max_channel(look.exitance) > kMostExitance) {
    throw InputError(fmt::format("a light is stronger than {:g} lm/m²", kMostExitance));
  }
  Object object;
  object.name = object_names_.next(clean_name(name, "object"));
  object.material = material(look);
  object.exitance = clamped(look.exitance, 0, kMostExitance);
  const bool open_on_both = look.two_sided && !shape->solid();
  object.sides = open_on_both && !object.emits() ? Sides::both : Sides::front;
  two_sided_lights_ += open_on_both && object.emits();
  object.shape = std::move(shape);
  scene_.objects.push_back(std::move(object));
  two_sided_.push_back(look.two_sided);
}

void Assembly::turn_rooms_over() {
  const double size = scene_.bounds().diagonal();
  const std::vector<Vec3> places = witnesses(scene_, 1e-6 * size);
  std::size_t rooms = 0;
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    Object& object = scene_.objects[i];
    const Shape& shape = *object.shape;
    if (!two_sided_[i] || object.emits() || !shape.solid() || shape.unbounded()) continue;
    const Bounds box = shape.bounds();
    if (box.diagonal() < kRoom * size) continue;
    if (std::none_of(places.begin(), places.end(), [&](const Vec3& place) {
          return box.encloses({place, place}) && shape.contains(place);
        })) {
      continue;
    }
    object.shape = std::make_shared<Complement>(object.shape);
    ++rooms;
  }
  notes_.add(rooms, "closed surface", "around eye or light: taken for a room, seen from inside");
}

SceneFile Assembly::finish(std::optional<int> up) {
  if (scene_.objects.empty()) throw InputError("the scene has no surfaces");
  turn_rooms_over();
  if (scene_.cameras.empty()) {
    scene_.cameras.push_back(default_camera(scene_, up ? *up : guessed_up_axis(scene_)));
  }
  notes_.add(flat_, "triangle", "without area: left out");
  notes_.add(repeated_, "triangle", "between the same points as another: left out");
  notes_.add(clamped_, "material",
             fmt::format("that reflects 1 or more: reduced to {}", kMostReflectance));
  notes_.add(two_sided_lights_, "light", "seen from both sides: shines from the front alone");
  return {std::move(scene_), notes_.lines()};
}

}  // namespace isolux
