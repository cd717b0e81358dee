#pragma once

#include "isolux/geometry/shape.h"

namespace isolux {

/// The sphere of the given centre and radius (m, > 0). One face.
class Sphere final : public Shape {
 public:
  Sphere(const Vec3& center, double radius);

  Bounds bounds() const override;
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  void occlude(const SegmentBlock& segments, double t_max,
               SegmentBlock::Mask& blocked) const override;
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  Vec3 center_;
  double radius_;
};

}  // namespace isolux
