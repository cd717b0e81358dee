#include "isolux/discretization/facet.h"

namespace isolux {
namespace {

/// How far the true surface may stand off a triangle: thrice the rise of a circular arc over any
/// side, and a little where it is flat.
double reach_of(const Triangulation& mesh, TriangleId id) {
  const auto& corners = mesh.triangle(id).vertices;
  double rise = 0, longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vertex& p = mesh.vertex(corners[k]);
    const Vertex& q = mesh.vertex(corners[(k + 1) % 3]);
    const Vec3 side = q.position - p.position;
    rise = std::max(rise, std::abs(dot(q.normal - p.normal, side)) / 8);
    longest = std::max(longest, length(side));
  }
  return 3 * rise + 0.01 * longest;
}

}  // namespace

Facet facet_of(const Triangulation& mesh, TriangleId id, const Vec3& middle) {
  const Triangle& triangle = mesh.triangle(id);
  const Vec3 a = mesh.vertex(triangle.vertices[0]).position;
  const Vec3 ab = mesh.vertex(triangle.vertices[1]).position - a;
  const Vec3 ac = mesh.vertex(triangle.vertices[2]).position - a;
  const Vec3 n = cross(ab, ac);
  const double squared = length_squared(n);
  return {narrow(a - middle),
          {narrow(cross(ac, n) / squared), narrow(cross(n, ab) / squared)},
          narrow(triangle.normal / reach_of(mesh, id)),
          mesh.vertex(triangle.vertices[0]).surface.object,
          triangle.vertices};
}

Bounds facet_box(const Triangulation& mesh, TriangleId id, const Vec3& middle) {
  const Triangle& triangle = mesh.triangle(id);
  Vec3 center;
  for (const VertexId v : triangle.vertices) center += mesh.vertex(v).position / 3;
  Bounds bounds;
  for (const VertexId v : triangle.vertices) {
    const Vec3 arm = mesh.vertex(v).position - center;
    bounds.include(center + arm * (1 + 3.01 * Facet::kOutside) - middle);
  }
  const double reach = 1.01 * reach_of(mesh, id);
  const Vec3& n = triangle.normal;
  const Vec3 room = Vec3{std::abs(n.x), std::abs(n.y), std::abs(n.z)} * reach;
  bounds.lower -= room;
  bounds.upper += room;
  return bounds;
}

}  // namespace isolux
