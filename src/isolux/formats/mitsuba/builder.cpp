#include "isolux/formats/mitsuba/builder.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "isolux/formats/colorimetry.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/mitsuba/parameters.h"
#include "isolux/scene/length.h"
#include "isolux/scene/spelling.h"

namespace isolux::mitsuba {
namespace {

using std::numbers::pi;

std::string name_of(const Element& element) {
  return std::string(element.text(element.find("id") ? "id" : "type"));
}

/// The angle of the picture's height in degrees, from one of width, height or diagonal.
double vertical_angle(const Element& sensor, double angle, std::string_view axis, double aspect) {
  if (axis == "smaller") axis = aspect > 1 ? "y" : "x";
  if (axis == "larger") axis = aspect > 1 ? "x" : "y";
  double half = std::tan(angle * pi / 360);
  if (axis == "x") {
    half /= aspect;
  } else if (axis == "diagonal") {
    half /= std::hypot(1, aspect);
  } else if (axis != "y") {
    find(sensor, "fov_axis")->fail("'fov_axis' must be x, y, diagonal, smaller or larger");
  }
  return 2 * std::atan(half) * 180 / pi;
}

/// The angle along the diagonal of a lens for 35 mm film, "50mm".
double angle_of_lens(const Element& sensor) {
  double length = 50;
  if (const Element* const parameter = find(sensor, "focal_length")) {
    std::string_view value = text(sensor, "focal_length");
    if (value.ends_with("mm")) value.remove_suffix(2);
    length = parse_number(value).value_or(0);
    if (!(length > 0)) parameter->fail("'focal_length' must be a length such as 50mm");
  }
  return 2 * std::atan(std::hypot(36, 24) / (2 * length)) * 180 / pi;
}

}  // namespace

const Element* Builder::child(const Element& object, std::string_view tag) const {
  for (const Element& element : object.children) {
    const Element& meant = document_.resolved(element);
    if (meant.is(tag)) return &meant;
  }
  return nullptr;
}

void Builder::add_scene(const Element& scene) {
  for (const Element& element : scene.children) {
    if (element.is("shape")) {
      add_shape(element);
    } else if (element.is("emitter")) {
      add_emitter(element);
    } else if (element.is("sensor")) {
      add_sensor(element);
    } else if (element.is("medium")) {
      assembly_.notes().add("media: clear air");
    } else if (element.is("path")) {
      assembly_.notes().left_out("path", "files are looked for in the scene's folder");
    } else if (element.is("ref")) {
      document_.target(element);  // an error where there is none
    }
  }
}

void Builder::add_shape(const Element& shape) {
  const std::string& type = shape.need("type");
  if (type == "shapegroup") return;
  if (type == "instance") return add_instance(shape);
  if (type == "merge") {
    for (const Element& inner : shape.children) {
      if (inner.is("shape")) add_shape(inner);
    }
    return;
  }
  const Part made = part(shape);
  made_at(shape, [&] { assembly_.add(made.name, made.shape, made.look); });
}

Builder::Part Builder::part(const Element& shape) {
  const Element* const bsdf = child(shape, "bsdf");
  const Element* const emitter = child(shape, "emitter");
  const Finish finish = bsdf ? finish_of(*bsdf) : Finish{};
  Part part{name_of(shape), nullptr, {finish.name, finish.reflectance, {}, false}};
  if (emitter) {
    if (emitter->need("type") == "area") {
      part.look.exitance = luminance_of_radiance(color(*emitter, "radiance", 1)) * pi;
    } else {
      assembly_.notes().left_out(emitter->text("type"), "surfaces shine as 'area' lights alone");
    }
  }
  const bool shines = max_channel(part.look.exitance) > 0;
  if (finish.clear && !shines) return part;
  part.look.two_sided = finish.two_sided && !shines;
  part.shape = surface(shape, part.look.two_sided);
  return part;
}

const std::vector<Builder::Part>& Builder::parts_of_group(const Element& group) {
  const auto [place, is_new] = groups_.try_emplace(&group);
  if (!is_new) return place->second;
  for (const Element& element : group.children) {
    const Element& shape = document_.resolved(element);
    if (!shape.is("shape")) continue;
    const std::string& type = shape.need("type");
    if (type == "instance" || type == "shapegroup" || type == "merge") {
      shape.fail(fmt::format("a group can't have a shape of type {}", in_quotes(type)));
    }
    place->second.push_back(part(shape));
  }
  return place->second;
}

void Builder::add_instance(const Element& shape) {
  const Element* const group = child(shape, "shape");
  if (!group || group->text("type") != "shapegroup") {
    shape.fail("an instance needs a <ref> to a shape of type 'shapegroup'");
  }
  const Affine map = transform(shape, "to_world");
  for (const Part& inner : parts_of_group(*group)) {
    if (!inner.shape) continue;
    made_at(shape, [&] {
      assembly_.add(name_of(shape) + '/' + inner.name, assembly_.placed(inner.shape, map),
                    inner.look);
    });
  }
}

void Builder::add_emitter(const Element& emitter) {
  const std::string& type = emitter.need("type");
  if (type != "point" && type != "spot" && type != "directional") {
    return assembly_.notes().left_out(type,
                                      "of lights without a surface, 'point', 'spot' and "
                                      "'directional' alone are known");
  }
  const bool distant = type == "directional";
  const Affine map = transform(emitter, "to_world");
  Source source;
  source.name = name_of(emitter);
  source.intensity = luminance_of_radiance(color(emitter, distant ? "irradiance" : "intensity", 1));
  if (!is_finite(source.intensity) || max_channel(source.intensity) > kMostExitance) {
    emitter.fail(fmt::format("a light is stronger than {:g}", kMostExitance));
  }
  source.position = map.point(vector(emitter, "position", {}));
  if (type != "point") {
    const Vec3 way = map.vector(vector(emitter, "direction", {0, 0, 1}));
    if (!(length(way) > 0)) emitter.fail("the direction of a light must not be zero");
    source.direction = normalized(way);
  }
  if (distant) source.kind = Source::Kind::directional;
  if (type == "spot") {
    source.dark_angle = number(emitter, "cutoff_angle", 20);
    source.full_angle = number(emitter, "beam_width", source.dark_angle * 0.75);
    if (!(source.dark_angle > 0 && source.dark_angle <= 180 && source.full_angle >= 0 &&
          source.full_angle < source.dark_angle)) {
      emitter.fail("'cutoff_angle' must be up to 180 degrees, and 'beam_width' less than that");
    }
    assembly_.notes().add("the edge of spots: fades by the law of glTF");
  }
  assembly_.sources().push_back(source);
}

void Builder::add_sensor(const Element& sensor) {
  const std::string& type = sensor.need("type");
  if (type != "perspective" && type != "thinlens") {
    return assembly_.notes().left_out(type, "cameras are perspective");
  }
  if (type == "thinlens") assembly_.notes().changed("thinlens", "a pinhole");
  Camera camera;
  camera.name = name_of(sensor);
  const Element* const film = child(sensor, "film");
  const auto size = [&](std::string_view name, int otherwise) {
    const double pixels = film ? number(*film, name, otherwise) : otherwise;
    if (!(pixels >= 1 && pixels <= 32768)) {
      find(*film, name)->fail(fmt::format("{} must be 1 to 32768", in_quotes(name)));
    }
    return static_cast<int>(pixels);
  };
  camera.width = size("width", 768);
  camera.height = size("height", 576);

  const Affine map = transform(sensor, "to_world");
  camera.eye = map.point({});
  camera.look_at = camera.eye + normalized(map.vector({0, 0, 1}));
  camera.up = normalized(map.vector({0, 1, 0}));
  if (map.determinant() < 0) {
    assembly_.notes().add("cameras that mirror: pictures are mirror images of Mitsuba's");
  }
  const Element* const fov = find(sensor, "fov");
  const double angle = fov ? number(sensor, "fov", 0) : angle_of_lens(sensor);
  if (!(angle > 0 && angle < 180)) {
    (fov ? *fov : sensor).fail("'fov' must lie between 0 and 180 degrees");
  }
  std::string_view axis = fov ? text(sensor, "fov_axis") : "diagonal";
  if (axis.empty()) axis = "x";
  camera.fov =
      vertical_angle(sensor, angle, axis, static_cast<double>(camera.width) / camera.height);
  assembly_.cameras().push_back(camera);
}

SceneFile Builder::finish() {
  assembly_.notes().add("no unit of length in Mitsuba: metres");
  return assembly_.finish();
}

}  // namespace isolux::mitsuba
