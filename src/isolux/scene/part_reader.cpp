#include "isolux/scene/part_reader.h"

#include <fmt/format.h>

namespace isolux {

Rgb read_reflectance(const Value& reflectance) {
  const Rgb color = reflectance.color();
  if (!(max_channel(color) < 1)) {
    reflectance.fail(
        fmt::format("'reflectance' must be less than 1, not {}: give the share of the "
                    "light that is reflected, such as 0.7",
                    max_channel(color)));
  }
  return color;
}

Camera read_camera(const Value& name, const Value& value) {
  const Fields fields(value, {"eye", "look_at", "up", "fov", "size"});
  constexpr int kLargestPicture = 32768;  // pixels a side
  Camera camera;
  camera.name = name.text();
  camera.eye = fields.require("eye").point();
  const Value look_at = fields.require("look_at");
  camera.look_at = look_at.point();
  const Vec3 view = camera.look_at - camera.eye;
  if (!(length(view) > 1e-9)) look_at.fail("'look_at' must differ from 'eye'");
  const std::optional<Value> up = fields.find("up");
  if (up) camera.up = up->direction();
  if (length(cross(normalized(view), camera.up)) < 1e-6) {
    (up ? *up : look_at)
        .fail(
            "'up' must not run along the view: for one straight up or down, use "
            "'up: y'");
  }
  if (const auto fov = fields.find("fov")) {
    camera.fov = fov->number();
    if (!(camera.fov > 0 && camera.fov < 180)) {
      fov->fail("'fov' must lie between 0 and 180 degrees, such as 50");
    }
  }
  if (const auto size = fields.find("size")) {
    const std::vector<Value> sides = size->items(2, 2);
    camera.width = sides[0].integer(1, kLargestPicture);
    camera.height = sides[1].integer(1, kLargestPicture);
  }
  return camera;
}

}  // namespace isolux
