#include "isolux/radiosity/form_factor.h"

#include <array>
#include <cassert>
#include <numbers>

namespace isolux {
namespace {

/// γ / sin γ of the angle between two unit vectors, of which `sine_squared` and `cosine` are given.
double angle_over_sine(double sine_squared, double cosine) {
  if (sine_squared < 0.03 && cosine > 0) {
    // The series of arcsin(s) / s; what is left out is below 1e-13.
    const double x = sine_squared;
    return 1 + x * (1. / 6 +
                    x * (3. / 40 +
                         x * (5. / 112 +
                              x * (35. / 1152 +
                                   x * (63. / 2816 + x * (231. / 13312 + x * (143. / 10240)))))));
  }
  const double sine = std::sqrt(sine_squared);
  return sine > 0 ? std::atan2(sine, cosine) / sine : 0;
}

}  // namespace

double form_factor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon) {
  constexpr std::size_t kMostCorners = 4;
  const std::size_t corners = polygon.size();
  assert(corners <= kMostCorners);

  // R_g: unit vectors to the corners of the part above the horizon.
  std::array<Vec3, 2 * kMostCorners> r;
  std::size_t n = 0;
  for (std::size_t i = 0; i < corners; ++i) {
    const Vec3 a = polygon[i] - point, b = polygon[i + 1 < corners ? i + 1 : 0] - point;
    const double above_a = dot(a, normal), above_b = dot(b, normal);
    if (above_a >= 0) r[n++] = normalized(a);
    if ((above_a >= 0) != (above_b >= 0)) {
      r[n++] = normalized(a + (b - a) * (above_a / (above_a - above_b)));
    }
  }
  if (n < 3) return 0;

  double sum = 0;
  for (std::size_t g = 0; g < n; ++g) {
    const Vec3& next = r[g + 1 < n ? g + 1 : 0];
    const Vec3 perpendicular = cross(r[g], next);
    sum += dot(normal, perpendicular) *
           angle_over_sine(length_squared(perpendicular), dot(r[g], next));
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

}  // namespace isolux
