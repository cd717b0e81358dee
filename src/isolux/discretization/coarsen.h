#pragma once

#include <vector>

#include "isolux/discretization/mesh_lookup.h"

namespace isolux {

/// The vertices of a mesh in nested subsets, each a few times coarser than the one before.
struct Coarsening {
  std::vector<VertexId> order;  ///< all vertices, the coarsest subset's first
  /// By vertex: where it lies among up to three vertices of the next coarser subset, all of them
  /// earlier in the order, near it on the same smooth surface, and around it, never to one side.
  /// Weights of zero: it belongs to the coarsest subset.
  std::vector<MeshPlace> places;
};

/// At most `levels` times coarser. Of each subset the next is a maximal independent set of its
/// vertices, corners and creases first, and besides those that would not lie between its
/// vertices. Vertices without triangles are in the coarsest. Cost: linear.
Coarsening coarsen(const Triangulation& mesh, int levels);

}  // namespace isolux
