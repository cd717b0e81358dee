#pragma once

#include "isolux/geometry/box.h"
#include "isolux/geometry/expression.h"

namespace isolux {

/// The solid where a function of x, y and z (m) is negative, within a box that cuts it off. Face 6
/// is the surface where the function is zero, 0 to 5 are those of the box.
///
/// Hits are isolated by interval arithmetic (Mitchell, "Robust ray intersection with interval
/// arithmetic", 1990): a piece of the line is dropped where the function surely has one sign,
/// searched where it is surely monotonic, else halved. So none is missed but for pairs closer than
/// 10⁻¹⁰ of the box's size, and where the function is so wild that more than 256 pieces of a line
/// stay undecided; those are judged by their ends.
class Implicit final : public Shape {
 public:
  Implicit(Expression function, const Vec3& lower, const Vec3& upper);

  Bounds bounds() const override { return box_.bounds(); }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool avoids(const Bounds& box) const override;
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  std::uint32_t face_count() const override { return 7; }
  ShapeDescription describe() const override;

 private:
  bool negative(const Vec3& point) const;
  /// The range of the function on a box.
  Enclosure range(const Bounds& box) const;
  /// The unit normal there, or `otherwise` where the function has no slope.
  Vec3 outward(const Vec3& point, const Vec3& otherwise) const;

  Expression function_;
  Box box_;
  Vec3 center_;
  double unit_;  ///< m, half the box's diagonal
};

}  // namespace isolux
