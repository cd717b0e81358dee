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
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  std::optional<double> area() const override;

 private:
  Vec3 center_;
  Frame frame_;  ///< its third axis is the torus's
  double major_, minor_;
};

}  // namespace isolux
