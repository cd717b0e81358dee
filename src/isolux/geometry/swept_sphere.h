#pragma once

#include "isolux/geometry/bernstein.h"
#include "isolux/geometry/curve.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// The solid that a ball of changing radius passes over on its way along a smooth curve through the
/// points (m; each with the ball's radius there): a bent wire, a horn, a string of beads. Its ends
/// are round; a loop has none. One face.
class SweptSphere final : public Shape {
 public:
  /// At least two points, no two in a row at the same place; of a loop three.
  SweptSphere(std::vector<CurvePoint> points, bool loop);

  Bounds bounds() const override { return bounds_; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  ShapeDescription describe() const override;

 private:
  /// One arc of the curve in the local frame.
  struct Arc {
    Bernstein<3> x, y, z, radius;
    Vec3 center;   ///< of a ball around all of its balls
    double reach;  ///< its radius

    Vec3 at(double u) const { return {x(u), y(u), z(u)}; }
  };
  struct Line;
  struct Interval;

  static void find_intervals(const Arc& arc, std::uint32_t index, const Line& line,
                             std::vector<Interval>& found);
  bool covers(const Arc& arc, const Vec3& p) const;

  std::vector<CurvePoint> points_;  ///< as given
  bool loop_;
  std::vector<Arc> arcs_;
  Bounds bounds_;
  Vec3 center_;      ///< of the bounds, the origin of the local frame
  double unit_ = 1;  ///< m, the length of the local frame
};

}  // namespace isolux
