#include "isolux/radiosity/form_factor.h"

#include <array>
#include <cassert>
#include <numbers>

namespace isolux {

double form_factor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon) {
  constexpr std::size_t kMostCorners = 8;
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
    const double sine = length(perpendicular);
    if (sine == 0) continue;
    const double gamma = std::atan2(sine, dot(r[g], next));
    sum += dot(normal, perpendicular) * (gamma / sine);
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

}  // namespace isolux
