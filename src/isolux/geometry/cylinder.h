#pragma once

#include "isolux/geometry/frustum.h"

namespace isolux {

/// The circular cylinder between two end points (m): a frustum whose radii are equal.
class Cylinder final : public Frustum {
 public:
  Cylinder(const Vec3& start, const Vec3& end, double radius, bool capped);
};

}  // namespace isolux
