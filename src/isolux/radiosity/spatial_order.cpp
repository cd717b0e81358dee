#include "isolux/radiosity/spatial_order.h"

#include <algorithm>

namespace isolux {
namespace {

/// The ten low bits of x with two zeros between each and the next.
std::uint32_t spread(std::uint32_t x) {
  x = (x | (x << 16)) & 0x030000ff;
  x = (x | (x << 8)) & 0x0300f00f;
  x = (x | (x << 4)) & 0x030c30c3;
  return (x | (x << 2)) & 0x09249249;
}

/// Place of a point along the Z-order curve (Morton 1966) through the bounds.
std::uint32_t morton(const Vec3& p, const Bounds& bounds) {
  std::uint32_t code = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = std::max(bounds.upper[axis] - bounds.lower[axis], 1e-300);
    const double part = (p[axis] - bounds.lower[axis]) / extent;
    code |= spread(static_cast<std::uint32_t>(std::clamp(part, 0.0, 1.0) * 1023)) << axis;
  }
  return code;
}

}  // namespace

std::span<const VertexId> SpatialOrder::of(const Triangulation& mesh) {
  const auto vertices = mesh.vertices();
  while (order_.size() < vertices.size()) order_.push_back(static_cast<VertexId>(order_.size()));
  if (order_.size() - sorted_ > sorted_ / 8) {
    Bounds bounds;
    for (const Vertex& vertex : vertices) bounds.include(vertex.position);
    std::vector<std::pair<std::uint32_t, VertexId>> codes;
    for (VertexId v = 0; v < vertices.size(); ++v) {
      codes.emplace_back(morton(vertices[v].position, bounds), v);
    }
    std::sort(codes.begin(), codes.end());
    for (std::size_t i = 0; i < codes.size(); ++i) order_[i] = codes[i].second;
    sorted_ = order_.size();
    receivers_.clear();
  }
  for (std::size_t i = receivers_.size(); i < order_.size(); ++i) {
    receivers_.push_back({vertices[order_[i]].gather_point, vertices[order_[i]].normal});
  }
  return order_;
}

}  // namespace isolux
