#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "isolux/core/vec3.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// The corners of a triangle.
using TriangleCorners = std::array<Vec3, 3>;

/// Where a line meets the plane of a triangle.
struct TriangleHit {
  double t = 0;                     ///< along the ray, in lengths of its direction
  std::uint32_t triangle = 0;       ///< index
  std::array<double, 3> weights{};  ///< barycentric, in the order of the corners
};

/// The point where the line meets the triangle, its sides included to within 1e-9 of their length;
/// false where there is none, or the line lies in the triangle's plane.
bool intersect_triangle(const TriangleCorners& corners, const Ray& ray, TriangleHit& hit);

/// A tree over plain triangles, for all hits along a ray.
///
/// Embree finds the triangles in single precision, t and weights are then computed in double
/// precision. Between neighbouring triangles no ray slips through; one on their common side may
/// meet both.
class TriangleTree {
 public:
  explicit TriangleTree(TriangleSoup soup);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;

  /// Appends all hits with t strictly inside the interval, unsorted.
  void all_hits(const Ray& ray, Interval within, std::vector<TriangleHit>& hits) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace isolux
