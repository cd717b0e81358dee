#pragma once

#include <string_view>

#include "isolux/core/vec3.h"

namespace isolux {

// What the constructors of shapes ask of their numbers. Each throws InputError with one line that
// begins with `what` (the name of the number) and says which values are allowed. The limits keep
// the fourth powers that some shapes need far from overflow and underflow.

inline constexpr double kShortestLength = 1e-12;  ///< m
inline constexpr double kLongestLength = 1e12;    ///< m

/// A point or vector with finite coordinates within ± kLongestLength.
void require_point(const Vec3& point, std::string_view what);
/// A length between kShortestLength and kLongestLength.
void require_length(double length, std::string_view what);
/// As require_length, or zero.
void require_length_or_zero(double length, std::string_view what);
/// A point as require_point, of a length as require_length.
void require_direction(const Vec3& direction, std::string_view what);

}  // namespace isolux
