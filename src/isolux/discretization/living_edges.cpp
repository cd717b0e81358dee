#include "isolux/discretization/living_edges.h"

#include <algorithm>

namespace isolux {

std::vector<Edge> living_edges(const Triangulation& mesh) {
  std::vector<Edge> sides;
  std::vector<std::uint32_t> end(mesh.vertices().size() + 1);  // of those whose first end is v − 1
  for (const Triangle& triangle : mesh.triangles()) {
    if (!triangle.alive) continue;
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(triangle.vertices[k], triangle.vertices[(k + 1) % 3]);
      sides.push_back({a, b, triangle.area});
      ++end[a + 1];
    }
  }
  for (std::size_t v = 1; v < end.size(); ++v) end[v] += end[v - 1];

  // Those of a first end come together, in the order of their second.
  std::vector<Edge> edges(sides.size());
  for (const Edge& side : sides) edges[end[side.a]++] = side;
  std::size_t n = 0, begin = 0;
  for (std::size_t v = 0; v + 1 < end.size(); begin = end[v++]) {
    const auto at = [&](std::size_t i) { return edges.begin() + static_cast<std::ptrdiff_t>(i); };
    std::sort(at(begin), at(end[v]), [](const Edge& e, const Edge& f) { return e.b < f.b; });
    for (std::size_t i = begin; i < end[v]; ++i) {
      if (n > 0 && edges[n - 1].key() == edges[i].key()) {
        edges[n - 1].area += edges[i].area;
      } else {
        edges[n++] = edges[i];
      }
    }
  }
  edges.resize(n);
  return edges;
}

}  // namespace isolux
