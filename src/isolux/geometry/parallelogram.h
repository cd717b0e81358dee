#pragma once

#include "isolux/geometry/plane.h"

namespace isolux {

/// The parallelogram corner + a u + b v, 0 ≤ a, b ≤ 1 (its edges included, so that a ray can't pass
/// between two that share one); u and v in m, not parallel. Its normal is u × v. One face.
class Parallelogram final : public Shape {
 public:
  Parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v);

  Bounds bounds() const override;
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  void occlude(const SegmentBlock& segments, double t_max,
               SegmentBlock::Mask& blocked) const override;
  bool solid() const override { return false; }
  bool contains(const Vec3&) const override { return false; }
  std::optional<double> area() const override;
  /// ⌈|u| / max_edge⌉ × ⌈|v| / max_edge⌉ cells of two triangles.
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  std::optional<PlaneHit> hit(const Ray& ray) const;
  /// Whether a point of the plane lies within.
  bool holds(const Vec3& point) const {
    constexpr double kSlack = 1e-13;  // rounding at an edge shared with another shape
    const double a = dot(dual_u_, point - corner_), b = dot(dual_v_, point - corner_);
    return (a >= -kSlack) & (a <= 1 + kSlack) & (b >= -kSlack) & (b <= 1 + kSlack);
  }
  static void occlude_by(const Parallelogram& shape, const SegmentBlock& segments, double t_max,
                         SegmentBlock::Mask& blocked);

  Vec3 corner_, u_, v_;
  Vec3 normal_;
  Vec3 dual_u_, dual_v_;  ///< a = dual_u · (p − corner), b likewise; 1/m
};

}  // namespace isolux
