#include "isolux/formats/mgf/surface.h"

#include <map>

#include "isolux/formats/face.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/tessellation.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux::mgf {
namespace {

using ShapePtr = std::shared_ptr<const Shape>;
using Vertices = Contexts<Vertex>;

ShapePtr turned_over(ShapePtr shape) { return std::make_shared<Reversed>(std::move(shape)); }

Surface read_sphere(const Statement& s, const Vertices& vertices) {
  s.expect_arguments(2, 2, "sph center radius");
  return {placed_ball(vertices.named(s, 1).point, s.number(2))};
}

Surface read_cylinder(const Statement& s, const Vertices& vertices) {
  s.expect_arguments(3, 3, "cyl start radius end");
  const double radius = s.number(2);
  return {placed_tube(vertices.named(s, 1).point, vertices.named(s, 3).point, radius, radius)};
}

Surface read_cone(const Statement& s, const Vertices& vertices) {
  s.expect_arguments(4, 4, "cone start start_radius end end_radius");
  const double start_radius = s.number(2), end_radius = s.number(4);
  if (std::min(start_radius, end_radius) < 0 && std::max(start_radius, end_radius) > 0) {
    s.fail(4, "the radii of a cone must have the same sign");
  }
  return {placed_tube(vertices.named(s, 1).point, vertices.named(s, 3).point, start_radius,
                      end_radius)};
}

/// The vertex that word 1 names, which needs a normal.
const Vertex& oriented_center(const Statement& s, const Vertices& vertices) {
  const Vertex& center = vertices.named(s, 1);
  if (is_short(length(center.normal))) {
    s.fail(1, "the vertex needs a normal (n) that says where the axis points");
  }
  return center;
}

Surface read_ring(const Statement& s, const Vertices& vertices) {
  s.expect_arguments(3, 3, "ring center inner_radius outer_radius");
  const Vertex center = oriented_center(s, vertices);
  const double inner = s.number_of_at_least_0(2), outer = s.number_of_at_least_0(3);
  if (inner > outer) s.fail(2, "the inner radius must be less than the outer one");
  return {placed_ring(center.point, center.normal, inner, outer)};
}

Surface read_torus(const Statement& s, const Vertices& vertices) {
  s.expect_arguments(3, 3, "torus center inner_radius outer_radius");
  const Vertex center = oriented_center(s, vertices);
  double inner = s.number(2), outer = s.number(3);
  const bool inward = outer < 0;
  if (inward) inner = -inner, outer = -outer;
  if (inner < 0) s.fail(2, "the radii of a torus must have the same sign");
  if (inner > outer) s.fail(2, "the inner radius must be less than the outer one");
  return {placed_torus(center.point, center.normal, inner, outer, inward)};
}

/// The vertices that the words from `first` to `last` name.
std::vector<Vertex> read_vertices(const Statement& s, std::size_t first, std::size_t last,
                                  const Vertices& vertices) {
  std::vector<Vertex> list;
  for (std::size_t i = first; i <= last; ++i) list.push_back(vertices.named(s, i));
  return list;
}

Contour points_of(const std::vector<Vertex>& vertices) {
  Contour contour;
  for (const Vertex& v : vertices) contour.push_back(v.point);
  return contour;
}

Region region_of(const Statement& s, const std::vector<Vertex>& corners) {
  try {
    return without_seams(points_of(corners));
  } catch (const InputError& error) {
    s.fail(0, error.what());
  }
}

Surface face_of(const Region& region, const std::vector<Vertex>& corners) {
  constexpr double kSmoothed = 1e-3;  // rad off the normal of the face
  Surface surface;
  surface.corners = corners.size();
  surface.flat = region.outline.empty() || is_flat(region);
  const Vec3 normal = doubled_area(region.outline);
  for (const Vertex& v : corners) {
    surface.smoothed |=
        length(cross(v.normal, normal)) > kSmoothed * length(v.normal) * length(normal);
  }
  surface.shape = placed_face(region);
  return surface;
}

Surface read_face(const Statement& s, const Vertices& vertices) {
  s.expect_arguments(3, Statement::kAnyNumber, "f v1 v2 v3 ...");
  const std::vector<Vertex> corners = read_vertices(s, 1, s.size() - 1, vertices);
  return face_of(region_of(s, corners), corners);
}

Surface read_face_with_holes(const Statement& s, const Vertices& vertices) {
  s.expect_arguments(3, Statement::kAnyNumber, "fh v1 v2 v3 ... - h1 h2 h3 ...");
  std::vector<Vertex> corners;
  Region region;
  for (std::size_t i = 1, end = 1; i < s.size(); i = end + 1) {
    for (end = i; end < s.size() && s.word(end) != "-";) ++end;
    if (end - i < 3) s.fail(std::min(end, s.size() - 1), "a contour has at least 3 vertices");
    const std::vector<Vertex> contour = read_vertices(s, i, end - 1, vertices);
    corners.insert(corners.end(), contour.begin(), contour.end());
    if (i == 1) {
      region.outline = points_of(contour);
    } else {
      region.holes.push_back(points_of(contour));
    }
  }
  return face_of(region, corners);
}

/// A prism between an end face and its copy moved by `offset`, closed and facing outward; the end
/// face's normal points against the offset.
TriangleSoup prism_triangles(const Region& end, const Vec3& offset) {
  TriangleSoup soup =
      *Polygon(end.outline, end.holes).triangulate(std::numeric_limits<double>::infinity());
  const auto corners = static_cast<std::uint32_t>(soup.points.size());
  TriangleSoup other = soup;
  for (Vec3& p : other.points) p += offset;
  flip(other);
  append(soup, other);
  std::uint32_t first = 0;
  const auto add_sides = [&](const Contour& contour) {
    const auto n = static_cast<std::uint32_t>(contour.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = first + i, b = first + (i + 1) % n;
      soup.triangles.push_back({a, a + corners, b});
      soup.triangles.push_back({b, a + corners, b + corners});
    }
    first += n;
  };
  add_sides(end.outline);
  for (const Contour& hole : end.holes) add_sides(hole);
  return soup;
}

Surface read_prism(const Statement& s, const Vertices& vertices) {
  s.expect_arguments(4, Statement::kAnyNumber, "prism v1 v2 v3 ... length");
  const std::vector<Vertex> corners = read_vertices(s, 1, s.size() - 2, vertices);
  const double length = s.number(s.size() - 1);
  Region end = region_of(s, corners);
  Surface surface;
  surface.corners = corners.size();
  if (end.outline.empty() || is_short(length)) {
    surface.shape = [](const Affine&) { return nullptr; };
    return surface;
  }
  const bool inward = length < 0;
  const Vec3 offset = normalized(doubled_area(end.outline)) * -length;
  if (inward) {  // the end face is seen from within
    std::reverse(end.outline.begin(), end.outline.end());
    for (Contour& hole : end.holes) std::reverse(hole.begin(), hole.end());
  }
  surface.shape = [=](const Affine& map) -> ShapePtr {
    TriangleSoup copy = prism_triangles(end, offset);
    for (Vec3& p : copy.points) p = map.point(p);
    if (map.determinant() < 0) flip(copy);
    const auto body =
        std::make_shared<TriangleMesh>(std::move(copy.points), std::move(copy.triangles));
    return inward ? turned_over(body) : body;
  };
  return surface;
}

using Reader = Surface (*)(const Statement&, const Vertices&);
const std::map<std::string_view, Reader> kReaders = {
    {"f", read_face},    {"fh", read_face_with_holes}, {"sph", read_sphere}, {"cyl", read_cylinder},
    {"cone", read_cone}, {"prism", read_prism},        {"ring", read_ring},  {"torus", read_torus}};

}  // namespace

bool is_surface(std::string_view keyword) { return kReaders.count(keyword) > 0; }

Surface read_surface(const Statement& s, const Contexts<Vertex>& vertices) {
  return kReaders.at(s.word(0))(s, vertices);
}

}  // namespace isolux::mgf
