#pragma once

#include <limits>
#include <optional>

#include "isolux/geometry/shape.h"

namespace isolux {

struct PlaneHit {
  double t;
  Vec3 point;  ///< on the plane
};

/// intersect_plane() without branches, for many lines at once.
struct PlaneCrossing {
  bool there;  ///< else nothing else counts
  double t;
  Vec3 point;
};

inline PlaneCrossing cross_plane(const Ray& ray, const Vec3& anchor, const Vec3& normal) {
  constexpr double kParallel = 1e-14;  // rad
  const double slope = dot(ray.direction, normal);
  const double t = dot(anchor - ray.origin, normal) / slope;
  const Vec3 point = ray.at(t);
  const bool there = (std::abs(slope) > kParallel * length(ray.direction)) &
                     (std::abs(t) <= std::numeric_limits<double>::max());
  return {there, t, point - normal * dot(point - anchor, normal)};
}

/// Where a line meets the plane through `anchor` with unit normal `normal`; nothing where the line
/// is parallel to it within rounding.
inline std::optional<PlaneHit> intersect_plane(const Ray& ray, const Vec3& anchor,
                                               const Vec3& normal) {
  const PlaneCrossing crossing = cross_plane(ray, anchor, normal);
  if (!crossing.there) return std::nullopt;
  return PlaneHit{crossing.t, crossing.point};
}

}  // namespace isolux
