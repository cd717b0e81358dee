#include "isolux/geometry/cylinder.h"

#include "isolux/geometry/require.h"

namespace isolux {
namespace {

double checked(double radius) {
  require_length(radius, "radius");
  return radius;
}

}  // namespace

Cylinder::Cylinder(const Vec3& start, const Vec3& end, double radius, bool capped)
    : Frustum(start, end, checked(radius), radius, capped) {}

}  // namespace isolux
