#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isolux/core/vec3.h"

namespace isolux {

// Regions of a plane, z = 0, bounded by rings: each lists corners, the region lying on its left, so
// that an outline runs counter-clockwise and holes run clockwise. `slack` (m) is what counts as no
// distance.

using Flat = std::vector<Vec3>;
using Ring = std::vector<std::uint32_t>;

/// The distance of p from the line through a and b, positive on its left.
double line_distance(const Vec3& a, const Vec3& b, const Vec3& p);

/// Whether p lies in the counter-clockwise triangle or within `slack` of it.
bool in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, double slack);

/// Whether the segments a b and c d come within `slack` of each other.
bool segments_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double slack);

/// One ring around the region inside the first ring and outside the others, which are joined to it
/// by seams, passed there and back; the rings don't touch. Throws InputError where the region is
/// too thin.
Ring with_seams(const Flat& corners, std::vector<Ring> rings, double slack);

/// Triangles, without new corners, of the region inside the first ring and outside the others; the
/// rings don't touch. Throws InputError where the region is too thin to be cut.
std::vector<std::array<std::uint32_t, 3>> clip_ears(const Flat& corners, std::vector<Ring> rings,
                                                    double slack);

}  // namespace isolux
