#pragma once

#include <array>
#include <vector>

#include "isolux/core/vec3.h"

namespace isolux {

/// A place on a curve, with a radius that changes along it.
struct CurvePoint {
  Vec3 p;
  double radius = 0;

  bool operator==(const CurvePoint&) const = default;
};

/// A cubic Bézier arc by its control points.
using CurveArc = std::array<CurvePoint, 4>;

/// The smooth curve through all points, one arc from each to the next: the centripetal spline of
/// Catmull and Rom (Yuksel, Schaefer and Keyser 2011), which has no cusps. `before` and `after` are
/// the neighbours that shape its ends; no two points in a row are the same.
std::vector<CurveArc> curve_through(const std::vector<CurvePoint>& points, const CurvePoint& before,
                                    const CurvePoint& after);

/// What `before` and `after` are where a curve simply ends: its second point reflected in its end.
CurvePoint straight_on(const CurvePoint& end, const CurvePoint& next);

}  // namespace isolux
