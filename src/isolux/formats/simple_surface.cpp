#include "isolux/formats/simple_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "isolux/core/error.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

constexpr double kFineness = 32;  ///< edges of triangles that stand for a shape, on its diagonal

/// −d, without −0.
Vec3 opposite(const Vec3& d) { return Vec3{} - d; }

/// Where a shape is put, and whether it is turned inside out there.
struct Placement {
  Affine map;
  bool inward = false;

  Vec3 direction(const Vec3& d) const {
    const Vec3 placed = normalized(map.vector(d));
    return inward ? opposite(placed) : placed;
  }
};

void turn_over(FacesSurface& surface) {
  for (auto& face : surface.faces) std::reverse(face.begin(), face.end());
}

FacesSurface box_faces(const Vec3& lower, const Vec3& upper) {
  FacesSurface box;
  for (int i = 0; i < 8; ++i) {
    box.points.push_back(
        {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z});
  }
  box.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return box;
}

FacesSurface faces_of(std::vector<Vec3> points, const ShapeDescription::Triangles& triangles) {
  FacesSurface surface{std::move(points), {}};
  for (const auto& [a, b, c] : triangles) surface.faces.push_back({a, b, c});
  return surface;
}

/// The faces of a shape that has no others, where it stands.
std::optional<FacesSurface> flat_surface(const ShapeDescription& shape) {
  if (shape.kind == "box") {
    return box_faces(*shape.find<Vec3>("lower"), *shape.find<Vec3>("upper"));
  }
  if (shape.kind == "parallelogram") {
    const Vec3 &c = *shape.find<Vec3>("corner"), &u = *shape.find<Vec3>("u"),
               &v = *shape.find<Vec3>("v");
    return FacesSurface{{c, c + u, c + u + v, c + v}, {{0, 1, 2, 3}}};
  }
  const auto* const points = shape.find<std::vector<Vec3>>("points");
  if (shape.kind == "polygon" && shape.fields.size() == 1) {
    std::vector<std::uint32_t> face(points->size());
    std::iota(face.begin(), face.end(), 0u);
    return FacesSurface{*points, {face}};
  }
  if (shape.kind == "mesh") {
    return faces_of(*points, *shape.find<ShapeDescription::Triangles>("triangles"));
  }
  return std::nullopt;
}

std::vector<SimpleSurface> cone_surfaces(ConeSurface side, bool open) {
  std::vector<SimpleSurface> surfaces{side};
  const Vec3 along = normalized(side.to - side.from), back = opposite(along);
  const auto cap = [&](const Vec3& center, const Vec3& normal, double radius) {
    if (!open && radius > 0) surfaces.push_back(RingSurface{center, normal, 0, radius});
  };
  cap(side.from, side.inward ? along : back, side.from_radius);
  cap(side.to, side.inward ? back : along, side.to_radius);
  return surfaces;
}

/// A shape with round parts, under a map that stretches all lengths by `factor`; empty where it is
/// none of these.
std::vector<SimpleSurface> round_surfaces(const ShapeDescription& shape, const Placement& at,
                                          double factor) {
  const auto point = [&](std::string_view key) { return at.map.point(*shape.find<Vec3>(key)); };
  const auto size = [&](std::string_view key) { return *shape.find<double>(key) * factor; };
  if (shape.kind == "sphere") {
    return {SphereSurface{point("center"), size("radius"), at.inward}};
  }
  if (shape.kind == "cylinder") {
    const double radius = size("radius");
    return cone_surfaces({point("from"), point("to"), radius, radius, at.inward},
                         shape.flag("open"));
  }
  if (shape.kind == "cone") {
    const auto& radii = *shape.find<std::vector<double>>("radii");
    return cone_surfaces(
        {point("from"), point("to"), radii[0] * factor, radii[1] * factor, at.inward},
        shape.flag("open"));
  }
  if (shape.kind == "disk") {
    const double* const hole = shape.find<double>("inner_radius");
    return {RingSurface{point("center"), at.direction(*shape.find<Vec3>("normal")),
                        hole ? *hole * factor : 0, size("radius")}};
  }
  if (shape.kind == "torus") {
    return {TorusSurface{point("center"), at.direction(*shape.find<Vec3>("axis")),
                         size("major_radius"), size("minor_radius"), at.inward}};
  }
  return {};
}

/// What the shape is made of; empty where that is not simple.
std::vector<SimpleSurface> surfaces_of(const ShapeDescription& shape, Placement at) {
  if (shape.transform) at.map = at.map * *shape.transform;
  if (shape.operands.size() == 1) {  // turned inside out
    at.inward = !at.inward;
    return surfaces_of(shape.operands.front(), at);
  }
  if (shape.flag("inward")) at.inward = !at.inward;
  if (auto faces = flat_surface(shape)) {
    for (Vec3& p : faces->points) p = at.map.point(p);
    if (at.inward != (at.map.determinant() < 0)) turn_over(*faces);
    return {std::move(*faces)};
  }
  const std::optional<double> factor = at.map.similarity();
  return factor ? round_surfaces(shape, at, *factor) : std::vector<SimpleSurface>{};
}

bool has(const SurfaceFormat& format, const SimpleSurface& surface) {
  if (std::holds_alternative<TorusSurface>(surface)) return format.torus;
  const auto* const flat = std::get_if<FacesSurface>(&surface);
  return !flat || std::all_of(flat->faces.begin(), flat->faces.end(),
                              [&](const auto& face) { return face.size() <= format.most_corners; });
}

}  // namespace

std::vector<SimpleSurface> simple_surfaces(const Object& object, const SurfaceFormat& format,
                                           std::vector<std::string>& triangulated) {
  const ShapeDescription shape = object.shape->describe();
  std::vector<SimpleSurface> surfaces = surfaces_of(shape, {});
  const bool fits = std::all_of(surfaces.begin(), surfaces.end(),
                                [&](const SimpleSurface& s) { return has(format, s); });
  if (fits && !surfaces.empty()) return surfaces;
  const double max_edge = shape.kind == "polygon" ? std::numeric_limits<double>::infinity()
                                                  : object.shape->bounds().diagonal() / kFineness;
  auto soup = object.shape->triangulate(max_edge);
  if (!soup) {
    throw InputError(
        fmt::format("object {} can't be written: {} has no such {}, and it can't be "
                    "cut into triangles; make it a mesh or leave it out",
                    in_quotes(object.name), format.name, shape.kind));
  }
  triangulated.push_back(object.name);
  return {faces_of(std::move(soup->points), soup->triangles)};
}

std::vector<std::string> notes_of(const Scene& scene, const SurfaceFormat& format,
                                  const std::vector<std::string>& triangulated) {
  std::vector<std::string> notes;
  if (!scene.cameras.empty()) {
    notes.push_back(
        fmt::format("cameras are left out ({}): {} has none", scene.cameras.size(), format.name));
  }
  if (!triangulated.empty()) {
    notes.push_back(fmt::format(
        "triangles stand for what {} does not have: {}", format.name,
        enumerated(std::vector<std::string_view>(triangulated.begin(), triangulated.end()))));
  }
  return notes;
}

}  // namespace isolux
