#include "isolux/formats/openscad/primitives.h"

#include "isolux/geometry/box.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/planar_region.h"
#include "isolux/geometry/prism.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux::openscad {
namespace {

void note_flat(const Context& context) {
  context.notes.add("solids without a volume are left out");
}

/// Whether the map keeps boxes along the axes.
bool keeps_axes(const Affine& map) {
  for (const Vec3& row : map.linear) {
    if ((row.x != 0) + (row.y != 0) + (row.z != 0) != 1) return false;
  }
  return true;
}

ShapePtr cube(const Context& context, const Node& node, const Affine& map) {
  const Arguments arguments(context.tree, node);
  const std::vector<double> sides = arguments.numbers("size", 3);
  const Vec3 size = Vec3{sides[0], sides[1], sides[2]} * context.unit;
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) return note_flat(context), nullptr;
  const Vec3 lower = arguments.flag("center") ? size * -0.5 : Vec3{};
  if (!keeps_axes(map)) {
    return placed(context, node, make<Box>(context, node, lower, lower + size), map);
  }
  const Vec3 a = map.point(lower), b = map.point(lower + size);
  return make<Box>(context, node, min(a, b), max(a, b));
}

ShapePtr sphere(const Context& context, const Node& node, const Affine& map) {
  const double radius = Arguments(context.tree, node).number("r") * context.unit;
  if (!(radius > 0)) return note_flat(context), nullptr;
  if (const auto factor = map.similarity()) {
    return make<Sphere>(context, node, map.translation, radius * *factor);
  }
  return placed(context, node, make<Sphere>(context, node, Vec3{}, radius), map);
}

ShapePtr cylinder(const Context& context, const Node& node, const Affine& map) {
  const Arguments arguments(context.tree, node);
  const double height = arguments.number("h") * context.unit;
  const double r1 = arguments.number("r1") * context.unit;
  const double r2 = arguments.number("r2") * context.unit;
  if (!(height > 0 && r1 >= 0 && r2 >= 0 && r1 + r2 > 0)) return note_flat(context), nullptr;
  const Vec3 start{0, 0, arguments.flag("center") ? -0.5 * height : 0};
  const Vec3 along{0, 0, height};
  if (const int corners = corner_count(arguments)) {
    const bool upward = r1 > 0;
    const Vec3 base = upward ? start : start + along;
    std::vector<Vec3> outline = regular_polygon(upward ? r1 : r2, corners);
    for (Vec3& p : outline) p = map.point(p + base);
    const double scale = upward ? r2 / r1 : r1 / r2;
    return make<Prism>(context, node, outline, std::vector<std::vector<Vec3>>{},
                       map.vector(upward ? along : -along),
                       PrismTop{map.point(base), {scale, scale}});
  }
  if (const auto factor = map.similarity()) {
    return make<Frustum>(context, node, map.point(start), map.point(start + along), r1 * *factor,
                         r2 * *factor, true);
  }
  return placed(context, node, make<Frustum>(context, node, start, start + along, r1, r2, true),
                map);
}

/// Adds the triangles of a face, given as places in `points`.
void add_face(const Context& context, const std::vector<std::uint32_t>& face, TriangleSoup& soup) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (face.size() == 3) {
    triangles = {{0, 1, 2}};
  } else if (face.size() > 3) {
    std::vector<Vec3> corners;
    for (const std::uint32_t i : face) corners.push_back(soup.points[i]);
    try {
      triangles = PlanarRegion(corners, {}).soup.triangles;
    } catch (const InputError&) {
      context.notes.add(
          "faces that are not flat, or cross themselves, are cut into triangles from "
          "their first corner");
      for (std::uint32_t i = 1; i + 1 < face.size(); ++i) triangles.push_back({0, i, i + 1});
    }
  }
  for (const auto& [a, b, c] : triangles) {
    const Vec3 &p = soup.points[face[a]], &q = soup.points[face[b]], &r = soup.points[face[c]];
    const double size = std::max({distance(p, q), distance(q, r), distance(r, p)});
    if (!(length(cross(q - p, r - p)) > 1e-11 * size * size)) continue;  // no area
    soup.triangles.push_back({face[a], face[b], face[c]});
  }
}

ShapePtr polyhedron(const Context& context, const Node& node, const Affine& map) {
  const Arguments arguments(context.tree, node);
  TriangleSoup soup;
  for (const Vec3& p : arguments.points("points", 3)) {
    soup.points.push_back(map.point(p * context.unit));
  }
  for (const auto& face : arguments.places("faces", soup.points.size())) {
    add_face(context, face, soup);
  }
  if (soup.triangles.empty()) return note_flat(context), nullptr;
  // Faces run clockwise in OpenSCAD, as seen from outside.
  const auto turn_over = [&] {
    for (auto& [a, b, c] : soup.triangles) std::swap(b, c);
  };
  if (map.determinant() > 0) turn_over();
  ShapePtr mesh = make<TriangleMesh>(context, node, soup.points, soup.triangles);
  if (!mesh->unbounded()) return mesh;
  context.notes.add("a polyhedron whose faces run the wrong way around is turned over");
  turn_over();
  return make<TriangleMesh>(context, node, std::move(soup.points), std::move(soup.triangles));
}

struct Kind {
  std::string_view name;
  ShapePtr (*make)(const Context&, const Node&, const Affine&);
};

constexpr Kind kKinds[] = {
    {"cube", cube}, {"sphere", sphere}, {"cylinder", cylinder}, {"polyhedron", polyhedron}};

}  // namespace

bool is_primitive(const Node& node) {
  for (const Kind& kind : kKinds) {
    if (kind.name == node.name) return true;
  }
  return false;
}

ShapePtr primitive(const Context& context, const Node& node, const Affine& map) {
  for (const Kind& kind : kKinds) {
    if (kind.name == node.name) return kind.make(context, node, map);
  }
  return nullptr;
}

}  // namespace isolux::openscad
