#pragma once

#include <memory>
#include <optional>

#include "isolux/core/affine.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// A shape seen through an affine map, which may shear and reflect. Outward normals stay outward,
/// those of an open surface stay on the same side of it. Faces and parts are the shape's own.
class Instance final : public Shape {
 public:
  /// Throws InputError where the map has no inverse, or its numbers are not finite or too large.
  Instance(std::shared_ptr<const Shape> shape, const Affine& map);

  Bounds bounds() const override { return mapped(shape_->bounds()); }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  bool solid() const override { return shape_->solid(); }
  bool contains(const Vec3& point) const override;
  bool unbounded() const override { return shape_->unbounded(); }
  std::uint32_t face_count() const override { return shape_->face_count(); }
  /// Known where the shape's is and the map keeps angles.
  std::optional<double> area() const override;
  /// The shape's triangles, cut so finely that they are small enough once mapped.
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

  std::size_t part_count() const override { return shape_->part_count(); }
  Bounds part_bounds(std::size_t part) const override { return mapped(shape_->part_bounds(part)); }
  void intersect_part(std::size_t part, const Ray& ray, Hits& hits) const override;
  bool part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const override;

  const std::shared_ptr<const Shape>& shape() const { return shape_; }
  const Affine& map() const { return map_; }

 private:
  Ray to_shape(const Ray& ray) const;
  void to_world(Hits& hits, std::size_t first) const;
  Bounds mapped(const Bounds& box) const;

  std::shared_ptr<const Shape> shape_;
  Affine map_, inverse_;
};

/// A shape without the instances around it, and the map of these together, where there are any.
struct Original {
  std::shared_ptr<const Shape> shape;
  std::optional<Affine> map;
};

Original original(std::shared_ptr<const Shape> shape);

}  // namespace isolux
