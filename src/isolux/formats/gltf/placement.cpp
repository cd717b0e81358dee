#include "isolux/formats/gltf/placement.h"

#include <algorithm>
#include <numbers>

#include "isolux/formats/assembly.h"

namespace isolux::gltf {
namespace {
using std::numbers::pi;

/// The rotation of a quaternion (x, y, z, w), made unit length.
Affine rotation(const Json& list) {
  const std::vector<double> q = list.numbers(4);
  const Vec3 axis{q[0], q[1], q[2]};
  if (!(length(axis) + std::abs(q[3]) > 1e-6)) list.fail("must be a quaternion of unit length");
  if (length(axis) == 0) return {};
  return Affine::rotate(axis, 2 * std::atan2(length(axis), q[3]));
}

/// A node looks, and shines, along its −z axis.
Vec3 forward(const Affine& map) { return normalized(map.vector({0, 0, -1})); }

}  // namespace

Affine map_of(const Json& node) {
  Affine map;
  if (const auto matrix = node.find("matrix")) {
    const std::vector<double> m = matrix->numbers(16);  // column by column
    map = {{Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}},
           {m[12], m[13], m[14]}};
  } else {
    if (const auto t = node.find("translation")) map = map * Affine::translate(t->vector());
    if (const auto r = node.find("rotation")) map = map * rotation(*r);
    if (const auto s = node.find("scale")) map = map * Affine::scale(s->vector());
  }
  if (!map.inverse()) node.fail("is scaled to nothing");
  return map;
}

Source source_of(const Json& light, const Affine& map) {
  Source source;
  source.name = clean_name(light.text("name"), "light");
  source.position = map.point({});
  source.direction = forward(map);
  const auto color = light.find("color");
  const Vec3 c = color ? color->vector() : Vec3{1, 1, 1};
  source.intensity = Rgb{c.x, c.y, c.z} * light.number("intensity", 1);
  if (!(min_channel(source.intensity) >= 0)) light.fail("must not be darker than black");
  const std::string type = light.require("type").text();
  if (type == "directional") {
    source.kind = Source::Kind::directional;
  } else if (type == "spot") {
    const Json spot = light.require("spot");
    const double full = spot.number("innerConeAngle", 0);
    const double dark = spot.number("outerConeAngle", pi / 4);
    if (!(full >= 0 && full < dark && dark <= pi / 2 + 1e-6)) {
      spot.fail("must have 0 <= innerConeAngle < outerConeAngle <= pi / 2");
    }
    source.full_angle = full * 180 / pi;
    source.dark_angle = dark * 180 / pi;
  } else if (type != "point") {
    light.fail("must be of type point, spot or directional");
  }
  return source;
}

std::optional<Camera> camera_of(const Json& json, const Affine& map) {
  const auto perspective = json.find("perspective");
  if (!perspective) return std::nullopt;
  const Json yfov = perspective->require("yfov");
  const double angle = yfov.number() * 180 / pi;
  if (!(angle > 0 && angle < 180)) yfov.fail("must lie between 0 and pi");
  const double aspect = perspective->number("aspectRatio", 4.0 / 3);
  if (!(aspect > 0)) perspective->fail("must have an aspectRatio of more than 0");
  Camera camera;
  camera.name = json.text("name");
  camera.eye = map.point({});
  camera.look_at = camera.eye + forward(map);
  camera.up = normalized(map.vector({0, 1, 0}));
  camera.fov = angle;
  camera.width = static_cast<int>(std::clamp(std::round(camera.height * aspect), 1.0, 32768.0));
  return camera;
}

}  // namespace isolux::gltf
