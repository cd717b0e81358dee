#pragma once

#include "isolux/geometry/shape.h"

namespace isolux {

/// The solid box between two corners (m), lower < upper in every coordinate. Six faces: face
/// 2 axis + 1 looks along +axis, face 2 axis along −axis (axis 0, 1, 2 for x, y, z).
class Box final : public Shape {
 public:
  Box(const Vec3& lower, const Vec3& upper);

  Bounds bounds() const override { return {lower_, upper_}; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  void occlude(const SegmentBlock& segments, double t_max,
               SegmentBlock::Mask& blocked) const override;
  bool avoids(const Bounds& box) const override;
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  std::uint32_t face_count() const override { return 6; }
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  /// The piece of a line inside the box, with the faces at its ends.
  struct Piece {
    double enter, leave;
    std::uint32_t enter_face, leave_face;
  };
  std::optional<Piece> inside(const Ray& ray) const;
  Hit hit(const Ray& ray, double t, std::uint32_t face) const;

  Vec3 lower_, upper_;
};

}  // namespace isolux
