#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace isolux {

/// A point, direction or displacement in space; metres unless said otherwise.
struct Vec3 {
  double x = 0, y = 0, z = 0;

  constexpr double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr bool operator==(const Vec3&) const = default;

  constexpr Vec3& operator+=(const Vec3& b) { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(const Vec3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr Vec3& operator*=(double s) { return x *= s, y *= s, z *= s, *this; }
};

constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, double s) { return a *= s; }
constexpr Vec3 operator*(double s, Vec3 a) { return a *= s; }
constexpr Vec3 operator/(Vec3 a, double s) { return a *= 1 / s; }

constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
constexpr double length_squared(const Vec3& a) { return dot(a, a); }
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline double distance(const Vec3& a, const Vec3& b) { return length(a - b); }

/// `a` at length 1; the zero vector stays zero.
inline Vec3 normalized(const Vec3& a) {
  const double l = length(a);
  return l > 0 ? a / l : a;
}

/// Whether `a` has length 1 within rounding.
constexpr bool is_unit(const Vec3& a) {
  const double off = length_squared(a) - 1;
  return -4e-15 < off && off < 4e-15;
}

/// The same as normalized(), but a unit vector stays as it is, so that one that was written can be
/// read back to the last bit.
inline Vec3 unit_vector(const Vec3& a) { return is_unit(a) ? a : normalized(a); }

/// The unit direction of `a` in the plane that the unit vector `normal` stands on.
inline Vec3 tangential(const Vec3& a, const Vec3& normal) {
  return normalized(a - normal * dot(a, normal));
}

/// From 0 to π, rad.
inline double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

constexpr Vec3 min(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
constexpr Vec3 max(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// A right-handed orthonormal frame whose third axis is the unit vector `n`.
struct Frame {
  Vec3 u, v, n;

  explicit Frame(const Vec3& normal) : n(normal) {
    const Vec3 helper = std::abs(n.x) > 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
    u = normalized(helper - n * dot(helper, n));
    v = cross(n, u);
  }
  Vec3 to_world(const Vec3& local) const { return u * local.x + v * local.y + n * local.z; }
};

/// An axis-parallel box; empty until something is included.
struct Bounds {
  Vec3 lower = Vec3{1, 1, 1} * std::numeric_limits<double>::infinity();
  Vec3 upper = Vec3{-1, -1, -1} * std::numeric_limits<double>::infinity();

  bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
  Vec3 center() const { return (lower + upper) * 0.5; }
  double diagonal() const { return empty() ? 0 : length(upper - lower); }
  /// Whether the open boxes have a point in common.
  bool overlaps(const Bounds& b) const {
    return lower.x < b.upper.x && b.lower.x < upper.x && lower.y < b.upper.y &&
           b.lower.y < upper.y && lower.z < b.upper.z && b.lower.z < upper.z;
  }
  /// Whether `b` lies inside, sides included.
  bool encloses(const Bounds& b) const {
    return lower.x <= b.lower.x && b.upper.x <= upper.x && lower.y <= b.lower.y &&
           b.upper.y <= upper.y && lower.z <= b.lower.z && b.upper.z <= upper.z;
  }
  void include(const Vec3& p) { lower = min(lower, p), upper = max(upper, p); }
  void include(const Bounds& b) { lower = min(lower, b.lower), upper = max(upper, b.upper); }
};

}  // namespace isolux
