#include "isolux/core/affine.h"

namespace isolux {

Affine Affine::translate(const Vec3& t) {
  Affine map;
  map.translation = t;
  return map;
}

Affine Affine::scale(const Vec3& s) {
  Affine map;
  for (int axis = 0; axis < 3; ++axis) map.linear[axis][axis] = s[axis];
  return map;
}

Affine Affine::rotate(const Vec3& axis, double radians) {
  const Vec3 a = normalized(axis);
  const double c = std::cos(radians), s = std::sin(radians);
  Affine map;
  // Rodrigues' formula, row by row.
  map.linear[0] = Vec3{c, -s * a.z, s * a.y} + a * (a.x * (1 - c));
  map.linear[1] = Vec3{s * a.z, c, -s * a.x} + a * (a.y * (1 - c));
  map.linear[2] = Vec3{-s * a.y, s * a.x, c} + a * (a.z * (1 - c));
  return map;
}

std::optional<double> Affine::similarity() const {
  const double squared = length_squared(linear[0]);
  if (!(squared > 0)) return std::nullopt;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double wanted = i == j ? squared : 0;
      if (!(std::abs(dot(linear[i], linear[j]) - wanted) <= 1e-12 * squared)) return std::nullopt;
    }
  }
  return std::sqrt(squared);
}

std::optional<Affine> Affine::inverse() const {
  const double det = determinant();
  const double size = length(linear[0]) * length(linear[1]) * length(linear[2]);
  if (!std::isfinite(det) || !(std::abs(det) > 1e-12 * size)) return std::nullopt;
  const Vec3 c0 = cross(linear[1], linear[2]) / det;
  const Vec3 c1 = cross(linear[2], linear[0]) / det;
  const Vec3 c2 = cross(linear[0], linear[1]) / det;
  Affine map;
  map.linear = {Vec3{c0.x, c1.x, c2.x}, Vec3{c0.y, c1.y, c2.y}, Vec3{c0.z, c1.z, c2.z}};
  map.translation = -map.vector(translation);
  return map;
}

Affine operator*(const Affine& a, const Affine& b) {
  Affine map;
  for (int row = 0; row < 3; ++row) map.linear[row] = b.transposed(a.linear[row]);
  map.translation = a.point(b.translation);
  return map;
}

}  // namespace isolux
