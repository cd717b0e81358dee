#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "isolux/core/vec3.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// The corners of a triangle.
using TriangleCorners = std::array<Vec3, 3>;

/// Where a ray meets a triangle.
struct TriangleHit {
  double t = 0;                ///< along the ray, in lengths of its direction
  std::uint32_t triangle = 0;  ///< index
};

/// Where (t) the line meets the triangle, its sides included to within 1e-9 of their length;
/// nothing where it does not, or lies in the triangle's plane.
std::optional<double> intersect_triangle(const TriangleCorners& corners, const Ray& ray);

/// A tree over plain triangles, for all hits along a ray.
///
/// Embree finds the triangles in single precision, t is then computed in double precision. Between
/// neighbouring triangles no ray slips through; one on their common side may meet both.
class TriangleTree {
 public:
  explicit TriangleTree(const TriangleSoup& soup);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;

  /// All hits of rays[i] with t strictly inside the interval, unsorted, into hits[i] (cleared
  /// first).
  void all_hits(std::span<const Ray> rays, Interval within,
                std::span<std::vector<TriangleHit>> hits) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace isolux
