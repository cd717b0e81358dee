#pragma once

#include <cmath>

#include "isolux/core/vec3.h"

namespace isolux {

/// The distance from a point to its neighbours that is wanted on a surface: `size` in all
/// directions, or where the surface is straight along one, its *ruling*, `stretch` times as much
/// along that.
struct PointSpacing {
  double size = 0;   ///< m
  Vec3 ruling = {};  ///< unit, tangential; zero where stretch is 1
  double stretch = 1;

  double longest() const { return size * stretch; }

  /// `d` as on a surface that is squeezed along the ruling until the spacing is `size` everywhere.
  Vec3 squeezed(const Vec3& d) const { return d - ruling * (dot(d, ruling) * (1 - 1 / stretch)); }
  Vec3 stretched(const Vec3& d) const { return d + ruling * (dot(d, ruling) * (stretch - 1)); }

  /// The length of squeezed(d), m.
  double measure(const Vec3& d) const { return length(squeezed(d)); }

  /// The spacing in a tangential unit direction, m.
  double along(const Vec3& direction) const { return size / measure(direction); }
};

}  // namespace isolux
