#pragma once

#include "isolux/geometry/shape.h"

namespace isolux {

/// The torus swept by a circle of radius `minor` whose centre runs along the circle of radius
/// `major` about `axis` (need not have length 1) through `center`; minor < major, m. One face.
class Torus final : public Shape {
 public:
  Torus(const Vec3& center, const Vec3& axis, double major, double minor);

  Bounds bounds() const override;
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  std::optional<double> area() const override;
  ShapeDescription describe() const override;

 private:
  /// A line in the torus' own frame, in lengths of its outer radius.
  struct LocalLine {
    Vec3 o, d;            ///< the point nearest to the centre, and the unit direction
    double shift, speed;  ///< m from the ray's origin to o; m for each t
  };
  LocalLine localize(const Ray& ray) const;
  bool may_meet(const LocalLine& line, double a, double b) const;

  Vec3 center_;
  Frame frame_;  ///< its third axis is the torus's
  double major_, minor_;
};

}  // namespace isolux
