#include "isolux/formats/pbrt/shapes.h"

#include <fmt/format.h>

#include "isolux/formats/mesh/ply.h"
#include "isolux/formats/pbrt/nurbs.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/tessellation.h"

namespace isolux::pbrt {
namespace {

using ShapePtr = std::shared_ptr<const Shape>;

/// Turns triangles to the side that the normals at their corners point to.
void face_along(TriangleSoup& soup, const std::vector<Vec3>& normals) {
  for (auto& [a, b, c] : soup.triangles) {
    const Vec3 n = cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
    if (dot(n, normals[a]) < 0) std::swap(b, c);
  }
}

TriangleSoup triangle_mesh(const Parameters& parameters) {
  TriangleSoup soup;
  soup.points = parameters.points("P");
  std::vector<std::uint32_t> order = parameters.indices("indices", soup.points.size());
  if (order.empty() && soup.points.size() == 3) order = {0, 1, 2};
  if (order.size() % 3 != 0) parameters.find("indices")->fail("'indices' needs triples");
  for (std::size_t i = 0; i < order.size(); i += 3) {
    soup.triangles.push_back({order[i], order[i + 1], order[i + 2]});
  }
  const std::vector<Vec3> normals = parameters.points("N");
  if (normals.size() >= soup.points.size()) face_along(soup, normals);
  return soup;
}

TriangleSoup bilinear_mesh(const Parameters& parameters) {
  TriangleSoup soup;
  soup.points = parameters.points("P");
  std::vector<std::uint32_t> order = parameters.indices("indices", soup.points.size());
  if (order.empty() && soup.points.size() == 4) order = {0, 1, 2, 3};
  if (order.size() % 4 != 0) parameters.find("indices")->fail("'indices' needs fours");
  for (std::size_t i = 0; i < order.size(); i += 4) {
    soup.triangles.push_back({order[i], order[i + 1], order[i + 3]});
    soup.triangles.push_back({order[i], order[i + 3], order[i + 2]});
  }
  return soup;
}

TriangleSoup ply_mesh(const Parameters& parameters, Includes& includes) {
  const std::string_view name = parameters.text("filename");
  const Parameter* const place = parameters.find("filename");
  if (!place) return {};
  SourceText source;
  try {
    source = includes.open(name);
  } catch (const InputError& error) {
    place->fail(error.what());
  }
  includes.close();
  Cutting cutting;
  return parse_ply(source, cutting);
}

/// A shape of one piece in its own frame; null where it is of no known kind.
ShapePtr round_shape(std::string_view kind, const Parameters& parameters,
                     const SourceLocation& where, Notes& notes) {
  const auto number = [&](std::string_view name, double otherwise) {
    return parameters.number(name).value_or(otherwise);
  };
  if (number("phimax", 360) < 360) notes.add("shapes that end at 'phimax': made whole");
  const double radius = number("radius", 1), inner = number("innerradius", 0);
  const Vec3 low{0, 0, number("zmin", -1)}, high{0, 0, number("zmax", 1)};
  const Vec3 center{0, 0, number("height", 0)};
  return made_at(where, [&]() -> ShapePtr {
    if (kind == "disk") return std::make_shared<Disk>(center, Vec3{0, 0, 1}, radius, inner);
    if (kind == "cylinder") return std::make_shared<Cylinder>(low, high, radius, false);
    if (kind != "sphere") return nullptr;
    if (parameters.find("zmin") || parameters.find("zmax")) {
      notes.add("spheres cut by 'zmin' or 'zmax': made whole");
    }
    return std::make_shared<Sphere>(Vec3{}, radius);
  });
}

}  // namespace

ShapePtr make_shape(std::string_view kind, const Parameters& parameters, const Affine& map,
                    bool reversed, bool two_sided, const SourceLocation& where, Includes& includes,
                    Assembly& assembly) {
  TriangleSoup soup;
  if (kind == "trianglemesh") {
    soup = triangle_mesh(parameters);
  } else if (kind == "bilinearmesh") {
    soup = bilinear_mesh(parameters);
  } else if (kind == "plymesh") {
    soup = ply_mesh(parameters, includes);
  } else if (ShapePtr shape = kind == "nurbs"
                                  ? make_nurbs(parameters, where, assembly)
                                  : round_shape(kind, parameters, where, assembly.notes())) {
    if (reversed && !two_sided) shape = std::make_shared<Reversed>(std::move(shape));
    return made_at(where, [&] { return std::make_shared<Instance>(shape, map); });
  } else {
    assembly.notes().add(
        "shapes other than meshes, spheres, disks, cylinders and NURBS up to degree 3: left out");
    return nullptr;
  }
  for (Vec3& p : soup.points) p = map.point(p);
  if (reversed != (map.determinant() < 0)) flip(soup);
  return made_at(where, [&] { return assembly.mesh(std::move(soup), two_sided); });
}

}  // namespace isolux::pbrt
