#include "isolux/formats/mesh/ply.h"
#include "isolux/formats/mitsuba/builder.h"
#include "isolux/formats/mitsuba/parameters.h"
#include "isolux/formats/obj/geometry.h"
#include "isolux/formats/placed_shape.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/tessellation.h"

namespace isolux::mitsuba {
namespace {

using ShapePtr = std::shared_ptr<const Shape>;

/// Its normal is that of the square under the map, also where that mirrors.
ShapePtr rectangle(const Affine& map) {
  Vec3 u = map.vector({2, 0, 0}), v = map.vector({0, 2, 0});
  const Vec3 corner = map.point({-1, -1, 0});
  if (map.determinant() < 0) std::swap(u, v);
  return std::make_shared<Parallelogram>(corner, u, v);
}

ShapePtr cube(const Affine& map) {
  return std::make_shared<Instance>(std::make_shared<Box>(Vec3{-1, -1, -1}, Vec3{1, 1, 1}), map);
}

/// A shape of one piece; nothing where it is of no such type.
PlacedShape whole_shape(const Element& shape) {
  const std::string& type = shape.need("type");
  if (type == "rectangle") return rectangle;
  if (type == "cube") return cube;
  if (type == "disk") return placed_ring({}, {0, 0, 1}, 0, 1);
  if (type != "sphere" && type != "cylinder") return {};
  const double radius = number(shape, "radius", 1);
  if (!(radius > 0)) find(shape, "radius")->fail("'radius' must be positive");
  if (type == "sphere") return placed_ball(vector(shape, "center", {}), radius);
  return placed_tube(vector(shape, "p0", {}), vector(shape, "p1", {0, 0, 1}), radius, radius);
}

}  // namespace

ShapePtr Builder::surface(const Element& shape, bool two_sided) {
  const std::string& type = shape.need("type");
  const Affine map = transform(shape, "to_world");
  const bool flipped = flag(shape, "flip_normals");
  if (type == "obj" || type == "ply") return mesh(shape, map, flipped, two_sided);
  const PlacedShape make = whole_shape(shape);
  if (!make) {
    assembly_.notes().left_out(type, "shapes that are not known");
    return nullptr;
  }
  const ShapePtr whole = made_at(shape, [&] { return make(map); });
  if (!whole) assembly_.notes().add("shapes too small to have an area: left out");
  return whole && flipped && !two_sided ? std::make_shared<Reversed>(whole) : whole;
}

ShapePtr Builder::mesh(const Element& shape, const Affine& map, bool flipped, bool two_sided) {
  const std::string_view name = text(shape, "filename");
  if (name.empty()) shape.fail("a mesh needs a <string> named 'filename'");
  const SourceText source = made_at(*find(shape, "filename"), [&] { return includes_.open(name); });
  includes_.close();
  Cutting cutting;
  TriangleSoup soup =
      shape.text("type") == "obj" ? parse_obj(source, cutting) : parse_ply(source, cutting);
  for (Vec3& p : soup.points) p = map.point(p);
  if (flipped != (map.determinant() < 0)) flip(soup);
  return made_at(shape, [&] { return assembly_.mesh(std::move(soup), two_sided); });
}

}  // namespace isolux::mitsuba
