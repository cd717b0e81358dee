#include <algorithm>

#include "isolux/core/error.h"
#include "isolux/discretization/triangulation.h"

namespace isolux {

Triangulation::Triangulation(const Rules& rules, const Bounds& bounds, std::vector<Vertex> vertices,
                             std::vector<Triangle> triangles)
    : Triangulation(rules, bounds) {
  const auto all_below = [](const auto& ids, std::size_t limit) {
    return std::all_of(ids.begin(), ids.end(), [&](auto id) { return id < limit; });
  };
  for (const Vertex& v : vertices) {
    if (!all_below(v.neighbours, vertices.size()) || !all_below(v.triangles, triangles.size())) {
      throw InputError("is damaged: a vertex has a neighbour that does not exist");
    }
  }
  for (const Triangle& t : triangles) {
    if (!all_below(t.vertices, vertices.size())) {
      throw InputError("is damaged: a triangle has a vertex that does not exist");
    }
    alive_ += t.alive;
  }
  vertices_ = std::move(vertices);
  triangles_ = std::move(triangles);
  for (VertexId v = 0; v < vertices_.size(); ++v) grid_.insert(v, vertices_[v].position);
  const std::vector<std::string> violations = validate();
  if (!violations.empty()) throw InputError("is damaged: " + violations.front());
}

void Triangulation::compact() {
  std::vector<TriangleId> id_now(triangles_.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    if (!triangles_[i].alive) continue;
    id_now[i] = static_cast<TriangleId>(n);
    triangles_[n++] = triangles_[i];
  }
  triangles_.resize(n);
  for (Vertex& vertex : vertices_) {
    for (TriangleId& t : vertex.triangles) t = id_now[t];
  }
}

VertexId Triangulation::restore_vertex(Vertex vertex) {
  vertex.neighbours.clear();
  vertex.triangles.clear();
  const auto id = static_cast<VertexId>(vertices_.size());
  grid_.insert(id, vertex.position);
  vertices_.push_back(std::move(vertex));
  return id;
}

TriangleId Triangulation::restore_triangle(const std::array<VertexId, 3>& corners,
                                           const Rgb& emission, const Rgb& shot, bool on_light) {
  const auto [a, b, c] = corners;
  if (std::max({a, b, c}) >= vertices_.size() || a == b || b == c || c == a) {
    throw InputError("a triangle without three vertices");
  }
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    int around = 0;
    for (TriangleId t : vertices_[p].triangles) {
      const auto& v = triangles_[t].vertices;
      around += std::find(v.begin(), v.end(), q) != v.end();
    }
    if (around >= 2) throw InputError("an edge with three triangles");
  }
  const TriangleId id = add_triangle(a, b, c);
  triangles_[id].emission = emission;
  triangles_[id].shot = shot;
  triangles_[id].on_light = on_light;
  return id;
}

void Triangulation::restore_edge(VertexId a, VertexId b) {
  if (std::max(a, b) >= vertices_.size() || a == b) {
    throw InputError("an edge without two vertices");
  }
  if (vertices_[a].on_light || vertices_[b].on_light) {
    throw InputError("a possible edge that belongs to a light");
  }
  add_edge(a, b);
}

}  // namespace isolux
