#include "isolux/geometry/require.h"

#include <fmt/format.h>

#include "isolux/core/error.h"

namespace isolux {
namespace {

bool is_length(double x) { return x >= kShortestLength && x <= kLongestLength; }

}  // namespace

void require_point(const Vec3& point, std::string_view what) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(point[axis]) <= kLongestLength) continue;
    throw InputError(
        fmt::format("{0}: coordinates must be finite numbers between -{1:g} and {1:g}, not {2}",
                    what, kLongestLength, point[axis]));
  }
}

void require_length(double length, std::string_view what) {
  if (is_length(length)) return;
  throw InputError(fmt::format("{}: must be a length between {:g} and {:g} m, not {}", what,
                               kShortestLength, kLongestLength, length));
}

void require_length_or_zero(double length, std::string_view what) {
  if (length != 0) require_length(length, what);
}

void require_direction(const Vec3& direction, std::string_view what) {
  require_point(direction, what);
  if (is_length(length(direction))) return;
  throw InputError(fmt::format("{}: ({}, {}, {}) is no direction; give a vector that is not zero",
                               what, direction.x, direction.y, direction.z));
}

}  // namespace isolux
