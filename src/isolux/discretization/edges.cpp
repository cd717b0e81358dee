#include <numbers>

#include "isolux/discretization/triangulation.h"

namespace isolux {
namespace {

/// The corner of a triangle that is neither a nor b.
VertexId opposite(const Triangle& triangle, VertexId a, VertexId b) {
  const auto& v = triangle.vertices;
  for (const VertexId corner : v) {
    if (corner != a && corner != b) return corner;
  }
  return v[0];
}

}  // namespace

void Triangulation::remove_edge(VertexId a, VertexId b) {
  std::erase(vertices_[a].neighbours, b);
  std::erase(vertices_[b].neighbours, a);
}

std::optional<TriangleId> Triangulation::triangle_at(VertexId a, VertexId b) const {
  for (const TriangleId t : vertices_[a].triangles) {
    const auto& v = triangles_[t].vertices;
    for (int k = 0; k < 3; ++k) {
      if (v[k] == a && v[(k + 1) % 3] == b) return t;
    }
  }
  return std::nullopt;
}

bool Triangulation::may_be_triangle(VertexId a, VertexId b, VertexId c) const {
  // Less than this part of the longest side's square, and the normal is rounding.
  constexpr double kLeastArea = 1e-7;
  const Vec3 &pa = vertices_[a].position, &pb = vertices_[b].position, &pc = vertices_[c].position;
  const Vec3 normal = cross(pb - pa, pc - pa);
  const double longest =
      std::max({length_squared(pb - pa), length_squared(pc - pb), length_squared(pa - pc)});
  const double twice_area = length(normal);
  if (!(twice_area > kLeastArea * longest) || longest > rules_.max_edge * rules_.max_edge) {
    return false;
  }
  const std::array<VertexId, 3> corners{a, b, c};
  for (int k = 0; k < 3; ++k) {
    const Vec3& n = vertices_[corners[k]].normal;
    if (!compatible(n, vertices_[corners[(k + 1) % 3]].normal)) return false;
    if (!(dot(n, normal) >= cos_normal_tolerance_ * twice_area)) return false;
  }
  return true;
}

bool Triangulation::flip(VertexId a, VertexId b) {
  // Four vertices on a circle have no wrong diagonal.
  constexpr double kSlack = 1e-9;
  const auto left = triangle_at(a, b), right = triangle_at(b, a);
  if (!left || !right) return false;
  const Triangle first = triangles_[*left], second = triangles_[*right];
  if (first.on_light || second.on_light || first.emission != second.emission) return false;
  const VertexId c = opposite(first, a, b), d = opposite(second, a, b);
  if (c == d || has_triangle(c, d)) return false;
  const auto at = [&](VertexId v) -> const Vec3& { return vertices_[v].position; };
  const double angle_c = angle_between(at(a) - at(c), at(b) - at(c));
  const double angle_d = angle_between(at(a) - at(d), at(b) - at(d));
  if (angle_c + angle_d <= std::numbers::pi + kSlack) return false;
  if (!may_be_triangle(c, d, b) || !may_be_triangle(d, c, a)) return false;

  remove(*left), remove(*right);
  remove_edge(a, b);
  const Rgb power = first.shot * first.area + second.shot * second.area;
  const TriangleId p = add_triangle(c, d, b), q = add_triangle(d, c, a);
  for (const TriangleId t : {p, q}) {
    triangles_[t].emission = first.emission;
    triangles_[t].shot = power / (triangles_[p].area + triangles_[q].area);
  }
  return true;
}

void Triangulation::make_delaunay(std::vector<std::pair<VertexId, VertexId>> edges) {
  std::size_t left = 16 * edges.size();
  while (!edges.empty() && left > 0) {
    const auto [a, b] = edges.back();
    edges.pop_back();
    const auto one = triangle_at(a, b), other = triangle_at(b, a);
    if (!one || !other) continue;
    const VertexId c = opposite(triangles_[*one], a, b), d = opposite(triangles_[*other], a, b);
    if (!flip(a, b)) continue;
    --left;
    for (const auto& edge : {std::pair(a, c), std::pair(c, b), std::pair(b, d), std::pair(d, a)}) {
      edges.push_back(edge);
    }
  }
}

std::optional<VertexId> Triangulation::split_edge(VertexId a, VertexId b,
                                                  const SurfacePoint& point) {
  const std::array<std::optional<TriangleId>, 2> parents{triangle_at(a, b), triangle_at(b, a)};
  if (!parents[0] && !parents[1]) return std::nullopt;
  for (const auto& parent : parents) {
    if (parent && triangles_[*parent].on_light) return std::nullopt;
  }

  // Tried with the vertex there, which goes again where a child would break a rule.
  const VertexId v = add_vertex(point);
  for (const auto& parent : parents) {
    if (!parent) continue;
    const VertexId c = opposite(triangles_[*parent], a, b);
    const auto [from, to] = parent == parents[0] ? std::pair(a, b) : std::pair(b, a);
    if (may_be_triangle(from, v, c) && may_be_triangle(v, to, c)) continue;
    vertices_.pop_back();
    grid_.erase(v, point.position);
    return std::nullopt;
  }

  std::vector<std::pair<VertexId, VertexId>> around;
  for (int side = 0; side < 2; ++side) {
    if (!parents[side]) continue;
    const Triangle parent = triangles_[*parents[side]];
    const VertexId c = opposite(parent, a, b);
    const auto [from, to] = side == 0 ? std::pair(a, b) : std::pair(b, a);
    remove(*parents[side]);
    for (const TriangleId t : {add_triangle(from, v, c), add_triangle(v, to, c)}) {
      triangles_[t].emission = parent.emission;
      triangles_[t].shot = parent.shot;
    }
    around.emplace_back(from, c), around.emplace_back(to, c);
  }
  remove_edge(a, b);
  make_delaunay(std::move(around));
  return v;
}

}  // namespace isolux
