#pragma once

#include <span>
#include <vector>

#include "isolux/discretization/triangulation.h"
#include "isolux/radiosity/form_factor.h"

namespace isolux {

/// The indices of the points along a Z-order curve through their bounds: neighbours in the list are
/// mostly neighbours in space.
std::vector<std::uint32_t> z_order(std::span<const Vec3> points);

/// The vertices of a growing triangulation in an order in which neighbours in space are mostly
/// neighbours in the list, so that their shadow rays run close together.
class SpatialOrder {
 public:
  /// All vertices, each once. Sorted anew where the mesh has grown by an eighth since the last
  /// time; until then the newborn come last, by birth. Valid until the next call.
  std::span<const VertexId> of(const Triangulation& mesh);

  /// Where the vertices of the last of() gather light, in its order.
  std::span<const Receiver> receivers() const { return receivers_; }

 private:
  std::vector<VertexId> order_;
  std::vector<Receiver> receivers_;
  std::size_t sorted_ = 0;
};

}  // namespace isolux
