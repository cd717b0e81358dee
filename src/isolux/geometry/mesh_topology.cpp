#include "isolux/geometry/mesh_topology.h"

#include <numeric>
#include <tuple>

namespace isolux {
namespace {

/// Disjoint sets of the numbers 0 … n − 1.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// For each point the number of the first that stands at the same place.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Vec3 &a = points[i], &b = points[j];
    return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, j);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// A side of a triangle, its ends in ascending order.
struct Side {
  std::uint32_t low, high;
  std::uint32_t triangle;
  bool upward;  ///< the triangle runs from low to high

  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

std::vector<Side> sorted_sides(const TriangleSoup& soup) {
  const std::vector<std::uint32_t> place = weld(soup.points);
  std::vector<Side> sides;
  sides.reserve(3 * soup.triangles.size());
  for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = place[soup.triangles[i][k]];
      const std::uint32_t b = place[soup.triangles[i][(k + 1) % 3]];
      sides.push_back({std::min(a, b), std::max(a, b), i, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.upward) <
           std::tie(b.low, b.high, b.triangle, b.upward);
  });
  return sides;
}

}  // namespace

MeshTopology find_topology(const TriangleSoup& soup, const std::vector<Vec3>& normals,
                           double flat) {
  MeshTopology topology;
  const std::vector<Side> sides = sorted_sides(soup);
  Groups groups(soup.triangles.size());
  for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
    for (next = i + 1; next < sides.size() && sides[i].same_edge(sides[next]);) ++next;
    if (next - i != 2 || sides[i].upward == sides[i + 1].upward) {
      topology.closed = false;
      continue;
    }
    const Vec3 &a = normals[sides[i].triangle], &b = normals[sides[i + 1].triangle];
    if (dot(a, b) > 0 && length(cross(a, b)) < flat) {
      groups.join(sides[i].triangle, sides[i + 1].triangle);
    }
  }
  topology.faces.resize(soup.triangles.size());
  for (std::uint32_t i = 0; i < topology.faces.size(); ++i) {
    const std::uint32_t root = groups.root(i);  // ≤ i
    topology.faces[i] = root == i ? topology.face_count++ : topology.faces[root];
  }
  return topology;
}

}  // namespace isolux
