#include "isolux/formats/radiance/surfaces.h"

#include <algorithm>

namespace isolux::radiance {
namespace {

Vec3 point(const Primitive& p, std::size_t i) {
  return {p.number(i), p.number(i + 1), p.number(i + 2)};
}

/// A sphere, or a bubble where it is seen from within; a negative radius makes one of the other.
Surface read_ball(const Primitive& p) {
  p.expect_numbers(4, 4, "x y z radius");
  const double radius = p.number(3);
  return {placed_ball(point(p, 0), p.type() == "bubble" ? -radius : radius)};
}

/// A cylinder, or a tube where it is seen from within.
Surface read_cylinder(const Primitive& p) {
  p.expect_numbers(7, 7, "x0 y0 z0 x1 y1 z1 radius");
  const double radius = p.type() == "tube" ? -p.number(6) : p.number(6);
  return {placed_tube(point(p, 0), point(p, 3), radius, radius)};
}

/// A cone, or a cup where it is seen from within.
Surface read_cone(const Primitive& p) {
  p.expect_numbers(8, 8, "x0 y0 z0 x1 y1 z1 radius0 radius1");
  const double start = p.number(6), end = p.number(7);
  if (std::min(start, end) < 0 && std::max(start, end) > 0) {
    p.numbers.fail(8, "the radii of a cone must have the same sign");
  }
  const double sign = p.type() == "cup" ? -1 : 1;
  return {placed_tube(point(p, 0), point(p, 3), sign * start, sign * end)};
}

Surface read_ring(const Primitive& p) {
  p.expect_numbers(8, 8, "x y z nx ny nz radius0 radius1");
  if (is_short(length(point(p, 3)))) p.numbers.fail(4, "the direction of a ring must not be zero");
  for (const std::size_t i : {6u, 7u}) {
    if (p.number(i) < 0) p.numbers.fail(i + 1, "the radius of a ring must not be negative");
  }
  const auto [inner, outer] = std::minmax({p.number(6), p.number(7)});
  return {placed_ring(point(p, 0), point(p, 3), inner, outer)};
}

Surface read_polygon(const Primitive& p) {
  const std::size_t count = p.number_count();
  if (count < 9 || count % 3 != 0) {
    p.numbers.fail(0, "a polygon has three numbers for each corner, and at least 3 corners");
  }
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < count; i += 3) corners.push_back(point(p, i));
  return polygon(corners);
}

struct Reader {
  std::string_view type;
  Surface (*read)(const Primitive& primitive);
};

constexpr Reader kReaders[] = {
    {"polygon", read_polygon}, {"sphere", read_ball}, {"bubble", read_ball},
    {"cone", read_cone},       {"cup", read_cone},    {"cylinder", read_cylinder},
    {"tube", read_cylinder},   {"ring", read_ring},
};

}  // namespace

Surface polygon(const std::vector<Vec3>& corners) {
  const Region region = without_seams(corners);
  return {placed_face(region), corners.size(), 0, region.outline.empty() || is_flat(region)};
}

const std::vector<std::string_view>& surface_types() {
  static const std::vector<std::string_view> types = [] {
    std::vector<std::string_view> all;
    for (const Reader& reader : kReaders) all.push_back(reader.type);
    return all;
  }();
  return types;
}

Surface read_surface(const Primitive& primitive) {
  const auto reader = std::find_if(std::begin(kReaders), std::end(kReaders),
                                   [&](const Reader& r) { return r.type == primitive.type(); });
  try {
    return reader->read(primitive);
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    if (message.starts_with(primitive.head.location().file + ':')) throw;
    primitive.head.fail(0, error.what());
  }
}

}  // namespace isolux::radiance
