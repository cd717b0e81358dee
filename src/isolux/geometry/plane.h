#pragma once

#include <optional>

#include "isolux/geometry/shape.h"

namespace isolux {

struct PlaneHit {
  double t;
  Vec3 point;  ///< on the plane
};

/// Where a line meets the plane through `anchor` with unit normal `normal`; nothing where the line
/// is parallel to it within rounding.
inline std::optional<PlaneHit> intersect_plane(const Ray& ray, const Vec3& anchor,
                                               const Vec3& normal) {
  constexpr double kParallel = 1e-14;  // rad
  const double slope = dot(ray.direction, normal);
  if (!(std::abs(slope) > kParallel * length(ray.direction))) return std::nullopt;
  const double t = dot(anchor - ray.origin, normal) / slope;
  if (!std::isfinite(t)) return std::nullopt;
  const Vec3 point = ray.at(t);
  return PlaneHit{t, point - normal * dot(point - anchor, normal)};
}

}  // namespace isolux
