#pragma once

#include "isolux/geometry/plane.h"

namespace isolux {

/// A flat disk; an annulus where inner_radius > 0. Radii in m, inner_radius < radius; `normal` need
/// not have length 1. One face.
class Disk final : public Shape {
 public:
  Disk(const Vec3& center, const Vec3& normal, double radius, double inner_radius = 0);

  Bounds bounds() const override;
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  bool solid() const override { return false; }
  bool contains(const Vec3&) const override { return false; }
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  std::optional<PlaneHit> hit(const Ray& ray) const;

  Vec3 center_, normal_;
  double radius_, inner_radius_;
};

/// How far a circle with that unit normal reaches from its centre along each axis.
Vec3 circle_extent(const Vec3& normal, double radius);

}  // namespace isolux
