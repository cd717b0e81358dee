#pragma once

#include "isolux/geometry/planar_region.h"
#include "isolux/geometry/plane.h"

namespace isolux {

/// A flat polygon with holes: a PlanarRegion seen. One face.
class Polygon final : public Shape {
 public:
  explicit Polygon(const std::vector<Vec3>& outline,
                   const std::vector<std::vector<Vec3>>& holes = {});

  Bounds bounds() const override { return region_.bounds; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  void occlude(const SegmentBlock& segments, double t_max,
               SegmentBlock::Mask& blocked) const override;
  bool solid() const override { return false; }
  bool contains(const Vec3&) const override { return false; }
  std::optional<double> area() const override;
  /// Those of the region, cut until they are small enough. The first points are the corners, in
  /// their order.
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  /// What is left of a side, in the region's frame: x p.x + y p.y ≥ least, (x, y) of unit length.
  struct Side {
    double x, y, least;  // m
    bool holds(double px, double py) const { return x * px + y * py >= least; }
  };

  std::optional<PlaneHit> hit(const Ray& ray) const;
  static void occlude_by(const Polygon& polygon, const SegmentBlock& segments, double t_max,
                         SegmentBlock::Mask& blocked);

  std::vector<Vec3> outline_;             ///< as given
  std::vector<std::vector<Vec3>> holes_;  ///< as given
  PlanarRegion region_;
  std::vector<std::array<Side, 3>> triangles_;  ///< of the region
};

}  // namespace isolux
