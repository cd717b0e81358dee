#pragma once

#include <memory>

#include "isolux/geometry/shape.h"

namespace isolux {

/// A surface turned over: its normals point the other way. It is open even where the shape is
/// solid: the skin of a ball seen from within, with nothing but air on either side (a Complement
/// fills all space outside). Faces, parts and bounds are the shape's own.
class Reversed : public Shape {
 public:
  /// Throws InputError where there is no shape.
  explicit Reversed(std::shared_ptr<const Shape> shape);

  Bounds bounds() const override { return shape_->bounds(); }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  void occlude(const SegmentBlock& segments, double t_max,
               SegmentBlock::Mask& blocked) const override;
  bool avoids(const Bounds& box) const override { return shape_->avoids(box); }
  bool solid() const override { return false; }
  bool contains(const Vec3&) const override { return false; }
  std::uint32_t face_count() const override { return shape_->face_count(); }
  std::optional<double> area() const override { return shape_->area(); }
  std::optional<TriangleSoup> triangulate(double max_edge) const override;

  std::size_t part_count() const override { return shape_->part_count(); }
  Bounds part_bounds(std::size_t part) const override { return shape_->part_bounds(part); }
  void intersect_part(std::size_t part, const Ray& ray, Hits& hits) const override;
  bool part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const override;
  ShapeDescription describe() const override;

 protected:
  std::shared_ptr<const Shape> shape_;
};

}  // namespace isolux
