#include "isolux/formats/simple_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "isolux/core/error.h"
#include "isolux/formats/approximation.h"
#include "isolux/geometry/planar_region.h"
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

/// One face; holes are joined to its outline by seams.
FacesSurface region_face(const PlanarRegion& region) {
  return {region.soup.points, {with_seams(region.corners, region.rings, region.slack)}};
}

/// The faces of a prism whose sides are flat: its base, its top, the sides.
FacesSurface prism_faces(const ShapeDescription& shape) {
  const auto* const holes = shape.find<ShapeDescription::Outlines>("holes");
  const PlanarRegion region(*shape.find<std::vector<Vec3>>("points"),
                            holes ? *holes : ShapeDescription::Outlines{});
  const Vec3 &along = *shape.find<Vec3>("along"), &n = region.frame.n;
  const double* const scale = shape.find<double>("scale");
  const double factor = scale ? *scale : 1;
  // The axis of the scaling, where it meets the base.
  Vec3 center = region.center;
  if (const Vec3* const given = shape.find<Vec3>("center")) {
    center = *given - along * (dot(*given - center, n) / dot(along, n));
  }
  FacesSurface prism = region_face(region);
  const auto corners = static_cast<std::uint32_t>(prism.points.size());
  std::vector<std::uint32_t> top = prism.faces.front();
  std::reverse(prism.faces.front().begin(), prism.faces.front().end());
  for (std::uint32_t i = 0; i < corners; ++i) {
    const Vec3& p = region.soup.points[i];
    prism.points.push_back(factor == 1 ? p + along : center + (p - center) * factor + along);
  }
  for (std::uint32_t& corner : top) corner += corners;
  if (factor > 0) prism.faces.push_back(std::move(top));
  for (const Ring& ring : region.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t a = ring[i], b = ring[(i + 1) % ring.size()];
      prism.faces.push_back({a, b, b + corners});
      if (factor > 0) prism.faces.back().push_back(a + corners);
    }
  }
  if (dot(along, n) < 0) turn_over(prism);
  return prism;
}

/// Whether all of the shape is flat.
bool is_flat(const ShapeDescription& shape) {
  if (shape.operands.size() == 1) return is_flat(shape.operands.front()->describe());
  if (shape.kind == "prism") {
    return !shape.find<double>("twist") && !shape.find<std::vector<double>>("scale");
  }
  return shape.kind == "box" || shape.kind == "parallelogram" || shape.kind == "polygon" ||
         shape.kind == "mesh" || shape.kind == "height_field";
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
  if (shape.kind == "polygon") {
    if (const auto* const holes = shape.find<ShapeDescription::Outlines>("holes")) {
      return region_face(PlanarRegion(*points, *holes));
    }
    std::vector<std::uint32_t> face(points->size());
    std::iota(face.begin(), face.end(), 0u);
    return FacesSurface{*points, {face}};
  }
  if (shape.kind == "prism" && is_flat(shape)) return prism_faces(shape);
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

/// The cones, cylinders and rings that straight lines sweep about an axis; empty where there are
/// others.
std::vector<SimpleSurface> revolution_surfaces(const ShapeDescription& shape, const Placement& at,
                                               double factor) {
  if (shape.flag("smooth") || shape.find<double>("angle")) return {};
  const auto& profile = *shape.find<ShapeDescription::Rows>("profile");
  const Vec3 &center = *shape.find<Vec3>("center"), &axis = *shape.find<Vec3>("axis");
  const std::size_t n = profile.size();
  const bool open = shape.flag("open");
  const bool ring = !open && (profile.front()[0] > 0 || profile.back()[0] > 0);
  double doubled_area = 0;  // of the profile, r to the right and z upwards
  for (std::size_t i = 0; i < n; ++i) {
    const auto &a = profile[i], &b = profile[(i + 1) % n];
    doubled_area += a[0] * b[1] - b[0] * a[1];
  }
  // The front of a line is on its right; outside, of one that goes around a solid to the left.
  const bool turned = !open && doubled_area < 0;
  std::vector<SimpleSurface> surfaces;
  for (std::size_t i = 0; i + (ring ? 0 : 1) < n; ++i) {
    const auto &a = profile[i], &b = profile[(i + 1) % n];
    if ((a[0] == 0 && b[0] == 0) || a == b) continue;
    const Vec3 from = at.map.point(center + axis * a[1]), to = at.map.point(center + axis * b[1]);
    if (a[1] == b[1]) {
      const bool up = (b[0] < a[0]) != turned;
      surfaces.push_back(RingSurface{from, at.direction(up ? axis : opposite(axis)),
                                     std::min(a[0], b[0]) * factor, std::max(a[0], b[0]) * factor});
    } else {
      const bool outward = (b[1] > a[1]) != turned;
      surfaces.push_back(ConeSurface{from, to, a[0] * factor, b[0] * factor, outward == at.inward});
    }
  }
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
  if (shape.kind == "revolution") return revolution_surfaces(shape, at, factor);
  return {};
}

/// What the shape is made of; empty where that is not simple.
std::vector<SimpleSurface> surfaces_of(const ShapeDescription& shape, Placement at) {
  if (shape.transform) at.map = at.map * *shape.transform;
  if (shape.operands.size() == 1) {  // turned inside out
    at.inward = !at.inward;
    return surfaces_of(shape.operands.front()->describe(), at);
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
                                           std::vector<Triangulated>& triangulated) {
  const ShapeDescription shape = object.shape->describe();
  std::vector<SimpleSurface> surfaces = surfaces_of(shape, {});
  const bool fits = std::all_of(surfaces.begin(), surfaces.end(),
                                [&](const SimpleSurface& s) { return has(format, s); });
  if (fits && !surfaces.empty()) return surfaces;
  const double max_edge = is_flat(shape) ? std::numeric_limits<double>::infinity()
                                         : object.shape->bounds().diagonal() / kFineness;
  try {
    Approximation found = approximate(*object.shape, max_edge);
    triangulated.push_back({object.name, found.deviation, found.lost});
    return {faces_of(std::move(found.soup.points), found.soup.triangles)};
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("object {} can't be written: {}", in_quotes(object.name), error.what()));
  }
}

std::vector<std::string> notes_of(const Scene& scene, const SurfaceFormat& format,
                                  const std::vector<Triangulated>& triangulated) {
  std::vector<std::string> notes;
  if (!scene.cameras.empty()) {
    notes.push_back(
        fmt::format("cameras are left out ({}): {} has none", scene.cameras.size(), format.name));
  }
  const auto lost = std::count_if(
      scene.sources.begin(), scene.sources.end(),
      [&](const Source& source) { return !format.infinity || source.kind == Source::Kind::point; });
  if (lost > 0) notes.push_back(fmt::format("lights without a surface are left out ({})", lost));
  if (scene.sky && scene.sky->shines() && !format.infinity) {
    notes.push_back(fmt::format("the sky is left out: {} has none", format.name));
  }
  const double exact = 1e-9 * scene.bounds().diagonal();
  std::vector<std::string_view> flat, near, torn;
  double deviation = 0, thin = 0;
  for (const Triangulated& t : triangulated) {
    (t.deviation > exact ? near : flat).push_back(t.object);
    if (t.lost > 0) torn.push_back(t.object);
    deviation = std::max(deviation, t.deviation);
    thin = std::max(thin, t.lost);
  }
  if (!flat.empty()) {
    notes.push_back(fmt::format("flat triangles stand for what {} does not have: {}", format.name,
                                enumerated(flat)));
  }
  if (!near.empty()) {
    notes.push_back(fmt::format("triangles stand for what {} does not have, up to {:.2g} m off: {}",
                                format.name, deviation, enumerated(near)));
  }
  if (!torn.empty()) {
    notes.push_back(
        fmt::format("parts thinner than {:.2g} m may be missing: {}", thin, enumerated(torn)));
  }
  return notes;
}

}  // namespace isolux
