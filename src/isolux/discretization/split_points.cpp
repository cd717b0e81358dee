#include "isolux/discretization/split_points.h"

#include "isolux/discretization/surface_walk.h"

namespace isolux {
namespace {

// Points on creases are this part of their edge inside, and never less than so many epsilons.
constexpr double kInset = 1e-3;
constexpr double kInsetEpsilons = 10;
// A crease is looked for within this part of the edge from it, more than it bulges between ends.
constexpr double kPull = 0.2;
// The surface is found within this part of the edge from where an arc over it would lie.
constexpr double kReach = 0.18;

ZonePoint zone_of(const Triangulation& mesh, TriangleId triangle) {
  const Triangle& t = mesh.triangle(triangle);
  ZonePoint zone;
  static_cast<SurfacePoint&>(zone) = mesh.vertex(t.vertices[0]);
  zone.emission = t.emission;
  return zone;
}

}  // namespace

std::optional<SurfacePoint> point_over_edge(const Triangulation& mesh, const RayCaster& rays,
                                            VertexId a, VertexId b) {
  const auto left = mesh.triangle_at(a, b), right = mesh.triangle_at(b, a);
  if (!left && !right) return std::nullopt;
  if (!left) std::swap(a, b);
  const SurfaceWalk walk(rays, mesh.rules().normal_tolerance);
  const Vertex &from = mesh.vertex(a), &to = mesh.vertex(b);
  ZonePoint middle = zone_of(mesh, left ? *left : *right);
  middle.position = (from.position + to.position) * 0.5;
  middle.normal = normalized(from.normal + to.normal);
  // As high as a circular arc rises whose normals those of the ends are.
  const Vec3 ab = to.position - from.position;
  middle.position += middle.normal * (dot(to.normal - from.normal, ab) / 8);
  const double along = length(ab);
  if (left && right) return walk.nearest(middle, kReach * along);

  const Vec3 outward = normalized(cross(ab, middle.normal));
  ZonePoint pulled = middle;
  pulled.position -= outward * (kPull * along);
  const auto inside = walk.nearest(pulled, kReach * along);
  if (!inside) return walk.nearest(middle, kReach * along);
  const Vec3 ahead = tangential(outward, inside->normal);
  const double far = 2 * kPull * along;
  if (walk.step(*inside, inside->position + ahead * far)) {
    return walk.nearest(middle, kReach * along);  // the edge of a hole in the mesh
  }
  const double inset = std::max(kInset * along, kInsetEpsilons * rays.epsilon());
  const Rim rim = walk.rim(*inside, ahead, 0, far, 0.1 * inset);
  return walk.over(rim.point, rim.point.position - ahead * inset);
}

std::optional<SurfacePoint> point_over_triangle(const Triangulation& mesh, const RayCaster& rays,
                                                TriangleId triangle,
                                                const std::array<double, 3>& weights) {
  const SurfaceWalk walk(rays, mesh.rules().normal_tolerance);
  ZonePoint point = zone_of(mesh, triangle);
  Vec3 position, normal;
  for (int k = 0; k < 3; ++k) {
    const Vertex& corner = mesh.vertex(mesh.triangle(triangle).vertices[k]);
    position += corner.position * weights[k];
    normal += corner.normal * weights[k];
  }
  point.position = position;
  point.normal = normalized(normal);
  return walk.nearest(point, 0.3 * std::sqrt(mesh.triangle(triangle).area));
}

}  // namespace isolux
