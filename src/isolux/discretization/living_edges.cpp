#include "isolux/discretization/living_edges.h"

#include <algorithm>

namespace isolux {

std::vector<Edge> living_edges(const Triangulation& mesh) {
  std::vector<Edge> edges;
  for (const Triangle& triangle : mesh.triangles()) {
    if (!triangle.alive) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangle.vertices[k], triangle.vertices[(k + 1) % 3]);
      edges.push_back({a, b, triangle.area});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& e, const Edge& f) {
    return std::pair(e.key(), e.area) < std::pair(f.key(), f.area);
  });
  std::size_t n = 0;
  for (const Edge& edge : edges) {
    if (n > 0 && edges[n - 1].key() == edge.key()) {
      edges[n - 1].area += edge.area;
    } else {
      edges[n++] = edge;
    }
  }
  edges.resize(n);
  return edges;
}

}  // namespace isolux
