#pragma once

#include <array>
#include <optional>

#include "isolux/core/vec3.h"

namespace isolux {

/// An affine map p ↦ L p + t, L a 3 × 3 matrix given by its rows.
struct Affine {
  std::array<Vec3, 3> linear = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  Vec3 translation;

  static Affine translate(const Vec3& t);
  static Affine scale(const Vec3& s);
  /// Right-handed rotation by `radians` about `axis`, which need not have length 1.
  static Affine rotate(const Vec3& axis, double radians);

  Vec3 point(const Vec3& p) const { return vector(p) + translation; }
  Vec3 vector(const Vec3& v) const {
    return {dot(linear[0], v), dot(linear[1], v), dot(linear[2], v)};
  }
  /// Lᵀ v: with the inverse map, it carries normals (not normalized).
  Vec3 transposed(const Vec3& v) const {
    return linear[0] * v.x + linear[1] * v.y + linear[2] * v.z;
  }
  double determinant() const { return dot(linear[0], cross(linear[1], linear[2])); }
  /// The factor, > 0, by which a map that keeps angles stretches; nothing for other maps.
  std::optional<double> similarity() const;
  /// The inverse map; nothing where L is singular or not finite.
  std::optional<Affine> inverse() const;
};

/// First `b`, then `a`.
Affine operator*(const Affine& a, const Affine& b);

}  // namespace isolux
