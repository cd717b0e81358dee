#pragma once

#include "isolux/geometry/shape.h"

namespace isolux {

/// A frustum of a right circular cone between two end points with a radius at each (m, ≥ 0, not
/// both 0). Open, it is the side alone (face 0). Capped, it is a solid: face 0 the side, 1 the cap
/// at `start`, 2 the cap at `end`.
class Frustum : public Shape {
 public:
  Frustum(const Vec3& start, const Vec3& end, double start_radius, double end_radius, bool capped);

  Bounds bounds() const override;
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  void occlude(const SegmentBlock& segments, double t_max,
               SegmentBlock::Mask& blocked) const override;
  bool solid() const override { return capped_; }
  bool contains(const Vec3& point) const override;
  std::uint32_t face_count() const override { return capped_ ? 3 : 1; }
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  /// A hit before its point and normal are known.
  struct Crossing {
    double t;
    std::uint32_t face;
  };
  struct Line;
  struct Crossings;
  static void occlude_regular(const Frustum& frustum, const SegmentBlock& segments, double t_max,
                              SegmentBlock::Mask& blocked, SegmentBlock::Mask& one_by_one);
  /// Whether the line passes the axis at more than the largest radius, with room for rounding.
  bool surely_missed_by(const Ray& ray) const {
    constexpr double kRoom = 1.001, kRounding = 1e-28;
    const Vec3 from_start = ray.origin - start_, across = cross(ray.direction, frame_.n);
    const double radius = std::max(start_radius_, end_radius_), s = dot(from_start, across);
    return s * s > kRoom * radius * radius * length_squared(across) +
                       kRounding * length_squared(from_start) * length_squared(ray.direction);
  }
  Line localize(const Ray& ray) const;
  Crossings crossings(const Line& line) const;
  Hit hit(const Line& line, const Crossing& crossing) const;
  TriangleSoup side_triangles(double segments, double max_edge) const;

  Vec3 start_, end_;
  Frame frame_;  ///< its third axis runs from start to end
  double length_;
  double start_radius_, end_radius_;
  double slope_;  ///< (end_radius − start_radius) / length
  bool capped_;
};

}  // namespace isolux
