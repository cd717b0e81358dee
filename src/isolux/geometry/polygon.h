#pragma once

#include "isolux/geometry/plane.h"

namespace isolux {

/// A flat polygon of 3 to 1000 corners (m), which may be concave and have holes. Its normal is the
/// one about which the corners run counter-clockwise; those of a hole may run either way. It must
/// be simple: edges meet at shared corners only, holes lie inside and not in one another; corners
/// in the middle of a straight side are fine. Corners may lie off the plane by 1e-6 of the
/// polygon's size, and are moved onto it. Messages number the corners of the holes on from those of
/// the outline. One face.
class Polygon final : public Shape {
 public:
  explicit Polygon(const std::vector<Vec3>& outline,
                   const std::vector<std::vector<Vec3>>& holes = {});

  Bounds bounds() const override { return bounds_; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  bool solid() const override { return false; }
  bool contains(const Vec3&) const override { return false; }
  std::optional<double> area() const override;
  /// The triangles of ear clipping (Meisters 1975), cut until they are small enough. The first
  /// points are the corners, in their order.
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  /// A corner in the plane; its z is zero.
  Vec3 flatten(const Vec3& point) const;
  std::optional<PlaneHit> hit(const Ray& ray) const;

  Vec3 center_;
  Frame frame_{Vec3{0, 0, 1}};
  Bounds bounds_;
  double slack_ = 0;                      ///< m, what counts as zero distance
  std::vector<Vec3> outline_;             ///< as given
  std::vector<std::vector<Vec3>> holes_;  ///< as given
  std::vector<Vec3> flat_;
  TriangleSoup soup_;
};

}  // namespace isolux
