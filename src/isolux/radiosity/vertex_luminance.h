#pragma once

#include <vector>

#include "isolux/discretization/triangulation.h"

namespace isolux {

/// Luminances of the light of every vertex, apart from all else that vertices know: what searches
/// over all triangles ask for, shot after shot, then fits into the caches.
struct VertexLuminance {
  std::vector<double> radiosity;         ///< of V.B, lm/m²
  std::vector<double> delta_irradiance;  ///< lx

  /// Makes room for all vertices, and reads those that were not there the last time.
  void add_newborn(const Triangulation& mesh) {
    const auto old = static_cast<VertexId>(radiosity.size());
    radiosity.resize(mesh.vertices().size());
    delta_irradiance.resize(mesh.vertices().size());
    for (VertexId v = old; v < radiosity.size(); ++v) read(v, mesh.vertex(v));
  }

  /// Reads what changed of one vertex.
  void read(VertexId v, const Vertex& vertex) {
    radiosity[v] = luminance(vertex.radiosity());
    delta_irradiance[v] = luminance(vertex.delta_irradiance);
  }
};

}  // namespace isolux
