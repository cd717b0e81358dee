#include "isolux/radiosity/form_factor.h"

#include <algorithm>
#include <cassert>
#include <numbers>

#include "isolux/core/vectorize.h"

namespace isolux {
namespace {

// Below this sin² γ the series is taken; what it leaves out is then below 1e-13.
constexpr double kSmallAngle = 0.03;

/// The series of arcsin(s) / s, x = s².
inline double arcsine_series(double x) {
  return 1 +
         x * (1. / 6 +
              x * (3. / 40 + x * (5. / 112 +
                                  x * (35. / 1152 + x * (63. / 2816 + x * (231. / 13312 +
                                                                           x * (143. / 10240)))))));
}

/// γ / sin γ of the angle between two unit vectors, of which `sine_squared` and `cosine` are given.
double angle_over_sine(double sine_squared, double cosine) {
  if (sine_squared < kSmallAngle && cosine > 0) return arcsine_series(sine_squared);
  const double sine = std::sqrt(sine_squared);
  return sine > 0 ? std::atan2(sine, cosine) / sine : 0;
}

/// Receivers coordinate by coordinate, with their results.
struct ReceiverBlock {
  static constexpr std::size_t kLanes = 16;
  using Lanes = std::array<double, kLanes>;
  alignas(64) Lanes x, y, z;     // points
  alignas(64) Lanes nx, ny, nz;  // normals
  alignas(64) Lanes factor;
  std::array<std::int64_t, kLanes> small;  // 1 where `factor` holds
};

/// form_factor() to a triangle where no corner lies below the horizon and the series holds.
ISOLUX_VECTORIZE
void small_form_factors(const std::array<Vec3, 3>& triangle, ReceiverBlock& block) {
  const Vec3 p = triangle[0], q = triangle[1], r = triangle[2];
  for (std::size_t i = 0; i < ReceiverBlock::kLanes; ++i) {
    const Vec3 point{block.x[i], block.y[i], block.z[i]};
    const Vec3 normal{block.nx[i], block.ny[i], block.nz[i]};
    bool small = true;
    const auto direction = [&](const Vec3& corner) {
      const Vec3 d = corner - point;
      small &= dot(d, normal) >= 0;
      return d / length(d);
    };
    const auto side = [&](const Vec3& a, const Vec3& b) {
      const Vec3 perpendicular = cross(a, b);
      const double x = length_squared(perpendicular);
      small &= (x < kSmallAngle) & (dot(a, b) > 0);
      return dot(normal, perpendicular) * arcsine_series(x);
    };
    const Vec3 a = direction(p), b = direction(q), c = direction(r);
    const double sum = side(a, b) + side(b, c) + side(c, a);
    block.factor[i] = std::abs(sum) / (2 * std::numbers::pi);
    block.small[i] = small;
  }
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

void form_factors(std::span<const Receiver> receivers, std::span<const std::uint32_t> indices,
                  const std::array<Vec3, 3>& triangle, std::span<double> factors) {
  constexpr std::size_t kLanes = ReceiverBlock::kLanes;
  for (std::size_t first = 0; first < indices.size(); first += kLanes) {
    const auto some = indices.subspan(first, std::min(kLanes, indices.size() - first));
    ReceiverBlock block;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const auto& [point, normal] = receivers[some[std::min(lane, some.size() - 1)]];
      block.x[lane] = point.x, block.y[lane] = point.y, block.z[lane] = point.z;
      block.nx[lane] = normal.x, block.ny[lane] = normal.y, block.nz[lane] = normal.z;
    }
    small_form_factors(triangle, block);
    for (std::size_t lane = 0; lane < some.size(); ++lane) {
      const auto& [point, normal] = receivers[some[lane]];
      factors[some[lane]] =
          block.small[lane] ? block.factor[lane] : form_factor(point, normal, triangle);
    }
  }
}

double sphere_form_factor(const Vec3& point, const Vec3& normal, const Vec3& center,
                          double radius) {
  // Notation: h = distance of the centre / radius, c = cos of the angle between it and the normal,
  // g² = h² − 1, w² = 1 − h² c².
  const Vec3 to_center = center - point;
  const double d = length(to_center), h = d / radius;
  if (!(h > 1)) return 0;
  const double hc = dot(to_center, normal) / radius, c = hc / h;
  if (hc >= 1) return c / (h * h);
  if (hc <= -1) return 0;
  const double g = std::sqrt((h - 1) * (h + 1)), w = std::sqrt((1 - hc) * (1 + hc));
  const double sum = std::atan2(w, g) + (c * std::atan2(w, -g * c) - g * w) / (h * h);
  return std::max(0.0, sum) / std::numbers::pi;
}

}  // namespace isolux
