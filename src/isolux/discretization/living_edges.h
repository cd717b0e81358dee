#pragma once

#include <cstdint>
#include <vector>

#include "isolux/discretization/triangulation.h"

namespace isolux {

/// An edge of living triangles, a < b.
struct Edge {
  VertexId a = 0, b = 0;
  double area = 0;  ///< of its triangles, m²

  std::uint64_t key() const { return std::uint64_t{a} << 32 | b; }
};

/// Every edge of a living triangle once, in ascending order of its ends. Cost: linear.
std::vector<Edge> living_edges(const Triangulation& mesh);

}  // namespace isolux
