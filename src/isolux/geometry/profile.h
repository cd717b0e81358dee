#pragma once

#include "isolux/geometry/bernstein.h"

#include <cstdint>
#include <vector>

namespace isolux {

/// A place on a profile: distance r ≥ 0 from an axis, and height z along it.
using ProfilePoint = std::array<double, 2>;

/// A part of a profile, as a cubic that is straight or curved.
struct ProfilePart {
  Bernstein<3> r, z;
  bool straight = true;
  std::uint32_t face = 0;  ///< straight parts have one each, curves one between two corners
  /// Of a straight part: the unit normal on its right, with nr r + nz z = away on its line.
  double nr = 0, nz = 0, away = 0, length = 0;
};

/// The parts of a polygon, or where `smooth` of curve_through() the points; there a point that is
/// given twice is a corner. What is not `open` is closed: along the axis where both ends lie on it,
/// else back to the first point. Parts along the axis are left out. Throws InputError where there
/// are too few points.
std::vector<ProfilePart> profile_parts(const std::vector<ProfilePoint>& points, bool smooth,
                                       bool open);

/// Whether parts that are closed (perhaps along the axis) go around (r, z) an odd number of times.
bool encloses(const std::vector<ProfilePart>& parts, double r, double z);

}  // namespace isolux
