#include <numbers>

#include "isolux/scene/scene.h"

namespace isolux {

Ray Camera::ray(double x, double y, double aspect) const {
  const Vec3 forward = normalized(look_at - eye);
  const Vec3 right = normalized(cross(forward, up));
  const Vec3 upward = cross(right, forward);
  const double half_height = std::tan(fov * std::numbers::pi / 360);
  const Vec3 across = right * ((2 * x - 1) * half_height * aspect);
  const Vec3 down = upward * ((1 - 2 * y) * half_height);
  return {eye, normalized(forward + across + down)};
}

}  // namespace isolux
