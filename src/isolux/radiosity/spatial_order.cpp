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

std::vector<std::uint32_t> z_order(std::span<const Vec3> points) {
  Bounds bounds;
  for (const Vec3& p : points) bounds.include(p);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> codes;
  codes.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    codes.emplace_back(morton(points[i], bounds), i);
  std::sort(codes.begin(), codes.end());
  std::vector<std::uint32_t> order;
  order.reserve(codes.size());
  for (const auto& [code, i] : codes) order.push_back(i);
  return order;
}

std::span<const VertexId> SpatialOrder::of(const Triangulation& mesh) {
  const auto vertices = mesh.vertices();
  while (order_.size() < vertices.size()) order_.push_back(static_cast<VertexId>(order_.size()));
  if (order_.size() - sorted_ > sorted_ / 8) {
    std::vector<Vec3> points;
    points.reserve(vertices.size());
    for (const Vertex& vertex : vertices) points.push_back(vertex.position);
    order_ = z_order(points);
    sorted_ = order_.size();
    receivers_.clear();
  }
  for (std::size_t i = receivers_.size(); i < order_.size(); ++i) {
    receivers_.push_back({vertices[order_[i]].gather_point, vertices[order_[i]].normal});
  }
  return order_;
}

}  // namespace isolux
