#include "isolux/discretization/triangulation.h"

#include <fmt/format.h>

#include "isolux/core/error.h"

namespace isolux {
namespace {

// Two edges that cross in the plane are apart in space where the gap between them there is more
// than this part of the longer one; a point is over a triangle where it is within this part of δ.
constexpr double kHeightGap = 0.3;

// Edges whose ends face this much (in cosine) beyond α_n still count when crossings are sought.
constexpr double kCrossingSlack = 0.06;

struct PlanePoint {
  double x, y;    // in the plane
  double height;  // above it
};

double orientation(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

struct PlaneEdge {
  VertexId a, b;
  PlanePoint pa, pb;
  double length;
};

constexpr PlanePoint kOrigin{0, 0, 0};

/// Whether the segment from the plane's origin to `p` crosses `edge`.
bool crosses(const PlanePoint& p, double length, const PlaneEdge& edge) {
  const auto [pa, pb] = std::pair(edge.pa, edge.pb);
  if (std::max(pa.x, pb.x) < std::min(0.0, p.x) || std::min(pa.x, pb.x) > std::max(0.0, p.x) ||
      std::max(pa.y, pb.y) < std::min(0.0, p.y) || std::min(pa.y, pb.y) > std::max(0.0, p.y)) {
    return false;
  }
  const double side_a = orientation(kOrigin, p, pa), side_b = orientation(kOrigin, p, pb);
  if ((side_a > 0) == (side_b > 0)) return false;
  const double side_0 = orientation(pa, pb, kOrigin), side_p = orientation(pa, pb, p);
  if ((side_0 > 0) == (side_p > 0)) return false;
  const double here = p.height * side_0 / (side_0 - side_p);
  const double there = pa.height + (pb.height - pa.height) * side_a / (side_a - side_b);
  return std::abs(here - there) <= kHeightGap * std::max(length, edge.length);
}

}  // namespace

/// The tangent plane of a point, in which edges near it are laid out.
struct Triangulation::PlaneFrame {
  Vec3 origin;
  Frame frame;

  explicit PlaneFrame(const SurfacePoint& point) : origin(point.position), frame(point.normal) {}
  PlanePoint project(const Vec3& p) const {
    const Vec3 d = p - origin;
    return {dot(d, frame.u), dot(d, frame.v), dot(d, frame.n)};
  }
};

Triangulation::Triangulation(const Rules& rules, const Bounds& bounds)
    : rules_(rules),
      cos_normal_tolerance_(std::cos(rules.normal_tolerance)),
      grid_(bounds.lower, rules.max_edge) {
  if (!(rules.max_edge > 0) || !std::isfinite(rules.max_edge)) {
    throw InputError("the longest edge δ must be a positive length");
  }
  if (!(rules.min_area > 0) || !std::isfinite(rules.min_area)) {
    throw InputError("the least area Δ must be positive");
  }
  if (!(rules.normal_tolerance > 0 && rules.normal_tolerance < 1.5707)) {
    throw InputError("the normal tolerance α_n must lie between 0 and 90 degrees");
  }
  if (!(bounds.diagonal() / rules.max_edge < 1e8)) {
    throw InputError(fmt::format(
        "the longest edge δ = {} m is too small for a scene {:.3g} m across; make it larger",
        rules.max_edge, bounds.diagonal()));
  }
}

double Triangulation::least_spacing() const { return 0.2 * std::sqrt(rules_.min_area); }

bool Triangulation::compatible(const Vec3& normal_a, const Vec3& normal_b) const {
  return dot(normal_a, normal_b) >= cos_normal_tolerance_;
}

bool Triangulation::has_edge(VertexId a, VertexId b) const {
  const auto& list = vertices_[a].neighbours;
  return std::find(list.begin(), list.end(), b) != list.end();
}

bool Triangulation::has_triangle(VertexId a, VertexId b) const {
  const auto& around = vertices_[a].triangles;
  return std::any_of(around.begin(), around.end(), [&](TriangleId t) {
    const auto& v = triangles_[t].vertices;
    return std::find(v.begin(), v.end(), b) != v.end();
  });
}

void Triangulation::add_edge(VertexId a, VertexId b) {
  if (has_edge(a, b)) return;
  vertices_[a].neighbours.push_back(b);
  vertices_[b].neighbours.push_back(a);
}

VertexId Triangulation::add_vertex(const SurfacePoint& point) {
  Vertex vertex;
  static_cast<SurfacePoint&>(vertex) = point;
  vertex.gather_point = point.position;
  return restore_vertex(std::move(vertex));
}

TriangleId Triangulation::add_triangle(VertexId a, VertexId b, VertexId c) {
  const Vec3 pa = vertices_[a].position;
  const Vec3 normal = cross(vertices_[b].position - pa, vertices_[c].position - pa);
  Triangle triangle;
  triangle.vertices = {a, b, c};
  triangle.area = length(normal) / 2;
  triangle.normal = normalized(normal);
  triangle.flat = std::all_of(triangle.vertices.begin(), triangle.vertices.end(), [&](VertexId v) {
    return distance(vertices_[v].normal, triangle.normal) < 1e-9;
  });
  const auto id = static_cast<TriangleId>(triangles_.size());
  triangles_.push_back(triangle);
  for (VertexId v : triangle.vertices) vertices_[v].triangles.push_back(id);
  add_edge(a, b), add_edge(b, c), add_edge(c, a);
  ++alive_;
  return id;
}

bool Triangulation::faces_outward(VertexId a, VertexId b, VertexId c) const {
  const Vec3 pa = vertices_[a].position;
  const Vec3 normal = cross(vertices_[b].position - pa, vertices_[c].position - pa);
  return dot(normal, vertices_[a].normal + vertices_[b].normal + vertices_[c].normal) > 0;
}

void Triangulation::add_light(const TriangleSoup& soup, SurfaceId surface, const Rgb& reflectance,
                              const Rgb& exitance) {
  std::vector<Vec3> normals(soup.points.size());
  for (const auto& [a, b, c] : soup.triangles) {
    const Vec3 n = cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
    for (std::uint32_t corner : {a, b, c}) normals[corner] += n;
  }
  const auto first = static_cast<VertexId>(vertices_.size());
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    const VertexId id = add_vertex({soup.points[i], normalized(normals[i]), surface, reflectance});
    vertices_[id].on_light = true;
  }
  for (const auto& [a, b, c] : soup.triangles) {
    const TriangleId id = add_triangle(first + a, first + b, first + c);
    triangles_[id].emission = exitance;
    triangles_[id].on_light = true;
  }
  for (std::size_t i = first; i < vertices_.size(); ++i) {
    Vertex& vertex = vertices_[i];
    Vec3 inside;
    for (TriangleId t : vertex.triangles) {
      for (VertexId corner : triangles_[t].vertices) inside += vertices_[corner].position;
    }
    if (vertex.triangles.empty()) continue;
    inside = inside / (3.0 * static_cast<double>(vertex.triangles.size()));
    vertex.gather_point = vertex.position + (inside - vertex.position) * 1e-3;
  }
}

std::vector<VertexId> Triangulation::connectable(const SurfacePoint& point) const {
  return connectable(point, neighbourhood(point), PlaneFrame(point));
}

Triangulation::Neighbourhood Triangulation::neighbourhood(const SurfacePoint& point) const {
  const double delta = rules_.max_edge, reach = delta * std::sqrt(5.0) / 2;
  Neighbourhood around;
  grid_.query(point.position, reach, around.far);
  std::vector<std::pair<double, VertexId>> near;
  std::erase_if(around.far, [&](VertexId w) {
    const Vertex& vertex = vertices_[w];
    const double squared = length_squared(vertex.position - point.position);
    if (squared <= delta * delta && !vertex.on_light && compatible(vertex.normal, point.normal)) {
      near.emplace_back(squared, w);
    }
    return squared > reach * reach;
  });
  std::sort(near.begin(), near.end());
  for (const auto& [squared, w] : near) around.near.push_back(w);
  return around;
}

std::vector<VertexId> Triangulation::connectable(const SurfacePoint& point,
                                                 const Neighbourhood& around,
                                                 const PlaneFrame& plane) const {
  const double reach = rules_.max_edge * std::sqrt(5.0) / 2;
  const auto squared_distance = [&](VertexId v) {
    return length_squared(vertices_[v].position - point.position);
  };

  // The segments of the possible-edge list that start within √5/2 δ, each once.
  const auto counts = [&](VertexId v) {
    return dot(vertices_[v].normal, point.normal) >= cos_normal_tolerance_ - kCrossingSlack;
  };
  std::vector<PlaneEdge> edges;
  for (VertexId a : around.far) {
    if (!counts(a)) continue;
    for (VertexId b : vertices_[a].neighbours) {
      if (b < a && squared_distance(b) <= reach * reach && counts(b)) continue;
      const Vec3& pa = vertices_[a].position;
      const Vec3& pb = vertices_[b].position;
      edges.push_back({a, b, plane.project(pa), plane.project(pb), distance(pa, pb)});
    }
  }

  // Each segment vw that crosses none of them is an edge.
  std::vector<VertexId> connected;
  for (VertexId w : around.near) {
    const PlanePoint p = plane.project(vertices_[w].position);
    const double segment = distance(vertices_[w].position, point.position);
    const bool blocked = std::any_of(edges.begin(), edges.end(), [&](const PlaneEdge& edge) {
      return edge.a != w && edge.b != w && crosses(p, segment, edge);
    });
    if (!blocked) connected.push_back(w);
  }
  return connected;
}

/// Whether no triangle stands on the side of the edge ab where `opposite` lies, and none is wound
/// from a to b.
bool Triangulation::side_free(VertexId a, VertexId b, VertexId opposite,
                              const PlaneFrame& plane) const {
  const PlanePoint pa = plane.project(vertices_[a].position);
  const PlanePoint pb = plane.project(vertices_[b].position);
  const double side = orientation(pa, pb, plane.project(vertices_[opposite].position));
  for (TriangleId t : vertices_[a].triangles) {
    const auto& v = triangles_[t].vertices;
    const auto at = std::find(v.begin(), v.end(), a) - v.begin();
    const VertexId after = v[(at + 1) % 3], before = v[(at + 2) % 3];
    if (after == b) return false;
    if (before == b && side * orientation(pa, pb, plane.project(vertices_[after].position)) > 0) {
      return false;
    }
  }
  return true;
}

/// Whether the three-cycle v a b, wound that way, may become a triangle: rule 4, an area, no vertex
/// inside, and every side free.
bool Triangulation::closes_triangle(VertexId v, VertexId a, VertexId b,
                                    std::span<const VertexId> near, const PlaneFrame& plane) const {
  if (!compatible(vertices_[a].normal, vertices_[b].normal)) return false;
  const PlanePoint pa = plane.project(vertices_[a].position);
  const PlanePoint pb = plane.project(vertices_[b].position);
  const double twice_area = orientation(kOrigin, pa, pb);
  const double longest = std::max(std::hypot(pa.x, pa.y), std::hypot(pb.x, pb.y));
  if (!(std::abs(twice_area) > 1e-7 * longest * longest)) return false;

  const double sign = twice_area > 0 ? 1 : -1;
  for (VertexId w : near) {
    if (w == a || w == b) continue;
    const PlanePoint p = plane.project(vertices_[w].position);
    if (sign * orientation(kOrigin, pa, p) >= 0 && sign * orientation(pa, pb, p) >= 0 &&
        sign * orientation(pb, kOrigin, p) >= 0 &&
        std::abs(p.height) < kHeightGap * rules_.max_edge) {
      return false;
    }
  }
  return side_free(v, a, b, plane) && side_free(a, b, v, plane) && side_free(b, v, a, plane);
}

/// Whether a living triangle with a corner among `near` lies over or under the plane's origin,
/// close to it.
bool Triangulation::covered(std::span<const VertexId> near, const PlaneFrame& plane) const {
  for (VertexId w : near) {
    for (TriangleId t : vertices_[w].triangles) {
      const auto& v = triangles_[t].vertices;
      const PlanePoint a = plane.project(vertices_[v[0]].position);
      const PlanePoint b = plane.project(vertices_[v[1]].position);
      const PlanePoint c = plane.project(vertices_[v[2]].position);
      const double part_a = orientation(b, c, kOrigin), part_b = orientation(c, a, kOrigin),
                   part_c = orientation(a, b, kOrigin);
      if (!(part_a > 0 && part_b > 0 && part_c > 0)) continue;
      const double height =
          (part_a * a.height + part_b * b.height + part_c * c.height) / (part_a + part_b + part_c);
      if (std::abs(height) < kHeightGap * rules_.max_edge) return true;
    }
  }
  return false;
}

bool Triangulation::crowded(const SurfacePoint& point) const {
  thread_local std::vector<VertexId> near;
  grid_.query(point.position, least_spacing(), near);
  return std::any_of(near.begin(), near.end(), [&](VertexId w) {
    const Vertex& vertex = vertices_[w];
    return !vertex.on_light && compatible(vertex.normal, point.normal) &&
           distance(vertex.position, point.position) < least_spacing();
  });
}

std::optional<VertexId> Triangulation::extend(const SurfacePoint& point) {
  if (crowded(point)) return std::nullopt;
  const PlaneFrame plane(point);
  const Neighbourhood around = neighbourhood(point);
  const std::vector<VertexId>& near = around.near;
  if (covered(near, plane)) return std::nullopt;

  const std::vector<VertexId> connected = connectable(point, around, plane);
  const VertexId v = add_vertex(point);
  for (VertexId w : connected) add_edge(v, w);
  for (std::size_t i = 0; i < connected.size(); ++i) {
    for (std::size_t j = i + 1; j < connected.size(); ++j) {
      VertexId a = connected[i], b = connected[j];
      if (!has_edge(a, b)) continue;
      if (!faces_outward(v, a, b)) std::swap(a, b);
      if (closes_triangle(v, a, b, near, plane)) add_triangle(v, a, b);
    }
  }
  return v;
}

std::optional<VertexId> Triangulation::split(TriangleId id, const SurfacePoint& point) {
  const Triangle parent = triangles_[id];
  if (!parent.alive || parent.on_light) return std::nullopt;
  const auto& corners = parent.vertices;

  // The point's barycentric coordinates, seen along the triangle's normal.
  std::array<double, 3> part;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = vertices_[corners[(k + 1) % 3]].position - point.position;
    const Vec3 b = vertices_[corners[(k + 2) % 3]].position - point.position;
    if (length(cross(a, b)) / 2 < rules_.min_area * (1 - 1e-9)) return std::nullopt;
    if (length(a) > rules_.max_edge) return std::nullopt;
    part[k] = dot(parent.normal, cross(a, b));
    sum += part[k];
  }
  for (double p : part) {
    if (!(p >= 0.02 * sum)) return std::nullopt;
  }

  const VertexId v = add_vertex(point);
  remove(id);
  for (VertexId corner : corners) add_edge(v, corner);
  for (int k = 0; k < 3; ++k) {
    const VertexId a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
    if (!compatible(vertices_[a].normal, point.normal) ||
        !compatible(vertices_[b].normal, point.normal) || !faces_outward(v, a, b)) {
      continue;
    }
    triangles_[add_triangle(v, a, b)].shot = parent.shot;
  }
  return v;
}

void Triangulation::remove(TriangleId id) {
  Triangle& triangle = triangles_[id];
  if (!triangle.alive || triangle.on_light) return;
  triangle.alive = false;
  --alive_;
  for (VertexId v : triangle.vertices) std::erase(vertices_[v].triangles, id);
}

}  // namespace isolux
