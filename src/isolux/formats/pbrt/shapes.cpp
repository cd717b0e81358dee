#include "isolux/formats/pbrt/shapes.h"

#include <fmt/format.h>

#include "isolux/formats/mesh/ply.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/nurbs.h"
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

/// The numbers of a parameter that must be there.
const std::vector<double>& numbers(const Parameters& parameters, std::string_view name,
                                   const SourceLocation& where) {
  const Parameter* const p = parameters.find(name);
  if (!p) throw InputError(where, fmt::format("'nurbs' lacks {}", in_quotes(name)));
  return p->numbers;
}

/// The order, which is the degree and one, and the knots along u or v. What is no order makes a
/// degree that is refused.
KnotVector knot_vector(const Parameters& parameters, char axis, const SourceLocation& where) {
  const auto order = parameters.number(fmt::format("{}order", axis)).value_or(0);
  const bool known = order >= 1 && order <= 100 && order == std::floor(order);
  return {known ? static_cast<std::size_t>(order) - 1 : 0,
          numbers(parameters, fmt::format("{}knots", axis), where)};
}

/// Whether a surface ends before its knots do.
bool is_cut(const Parameters& parameters, const KnotVector& vector, char axis) {
  const auto& knots = vector.knots;
  if (knots.size() < 2 * vector.degree + 2) return false;
  const auto end = [&](char which, double knot) {
    return parameters.number(fmt::format("{}{}", axis, which)).value_or(knot) != knot;
  };
  return end('0', knots[vector.degree]) || end('1', knots[knots.size() - vector.degree - 1]);
}

/// Those of version 3; null where a degree is above 3.
ShapePtr nurbs(const Parameters& parameters, const SourceLocation& where, Notes& notes) {
  const KnotVector u = knot_vector(parameters, 'u', where), v = knot_vector(parameters, 'v', where);
  if (std::max(u.degree, v.degree) > 3) return nullptr;
  if (is_cut(parameters, u, 'u') || is_cut(parameters, v, 'v')) {
    notes.add("NURBS that end before their knots do: made whole");
  }
  const bool weighted = parameters.find("Pw") != nullptr;
  const auto& list = numbers(parameters, weighted ? "Pw" : "P", where);
  const std::size_t stride = weighted ? 4 : 3;
  const double nu = parameters.number("nu").value_or(0), nv = parameters.number("nv").value_or(0);
  if (!(nu >= 1 && nv >= 1 && nu == std::floor(nu) &&
        nu * nv * static_cast<double>(stride) == static_cast<double>(list.size()))) {
    throw InputError(where, fmt::format("'nurbs' has {} by {} points, which {} numbers are not", nu,
                                        nv, list.size()));
  }
  Nurbs::Points points(static_cast<std::size_t>(nv));
  Nurbs::Weights weights(weighted ? points.size() : 0);
  for (std::size_t i = 0; i < list.size(); i += stride) {
    const std::size_t row = i / stride / static_cast<std::size_t>(nu);
    const double weight = weighted ? list[i + 3] : 1;
    points[row].push_back(Vec3{list[i], list[i + 1], list[i + 2]} / weight);
    if (weighted) weights[row].push_back(weight);
  }
  return made_at(
      where, [&] { return std::make_shared<Nurbs>(u, v, std::move(points), std::move(weights)); });
}

/// A shape of one piece in its own frame; null where it is of no known kind.
ShapePtr round_shape(std::string_view kind, const Parameters& parameters,
                     const SourceLocation& where, Notes& notes) {
  if (kind == "nurbs") return nurbs(parameters, where, notes);
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
  } else if (ShapePtr shape = round_shape(kind, parameters, where, assembly.notes())) {
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
