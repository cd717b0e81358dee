#pragma once

#include "isolux/formats/rayshade/model.h"

namespace isolux::rayshade {

/// How planes are cut: to squares around the point nearest to the middle of the scene.
struct PlaneCut {
  Vec3 middle;      ///< m
  double side = 0;  ///< m

  /// The plane's square, seen in the world; `map` is from the plane's frame to there.
  ShapePtr square(const Plane& plane, const Affine& map) const;
  /// The cube behind that square, seen in the plane's frame.
  ShapePtr half_space(const Plane& plane, const Affine& map) const;
};

/// The point of the plane that is nearest to `p`.
inline Vec3 foot_on(const Plane& plane, const Vec3& p) {
  return p - plane.normal * dot(p - plane.point, plane.normal);
}

/// The plane seen through the map.
Plane mapped(const Plane& plane, const Affine& map);

}  // namespace isolux::rayshade
