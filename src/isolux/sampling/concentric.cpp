#include "isolux/sampling/concentric.h"

#include <cmath>
#include <numbers>

namespace isolux {
namespace {

constexpr double kEighth = std::numbers::pi / 4;

}  // namespace

Point2 square_to_disk(const Point2& p) {
  if (p.x == 0 && p.y == 0) return {0, 0};
  const bool flat = std::abs(p.x) > std::abs(p.y);
  const double radius = flat ? p.x : p.y;
  const double angle = flat ? kEighth * (p.y / p.x) : 2 * kEighth - kEighth * (p.x / p.y);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Point2 disk_to_square(const Point2& p) {
  const double radius = std::hypot(p.x, p.y);
  if (std::abs(p.x) > std::abs(p.y)) {
    return {std::copysign(radius, p.x), radius * std::atan(p.y / std::abs(p.x)) / kEighth};
  }
  if (p.y == 0) return {0, 0};
  return {radius * std::atan(p.x / std::abs(p.y)) / kEighth, std::copysign(radius, p.y)};
}

}  // namespace isolux
