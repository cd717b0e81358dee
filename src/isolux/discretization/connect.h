#pragma once

#include <array>
#include <vector>

#include "isolux/discretization/cover_points.h"

namespace isolux {

/// A triangle between three of a cover's points, counter-clockwise, and how many of its corners
/// have it in their star.
struct StarTriangle {
  std::array<std::uint32_t, 3> corners;
  int votes = 0;
};

/// The triangles of each point's Delaunay star among the points that its surface runs on to, laid
/// out in its tangent plane; ordered by votes, three first. Where all stars agree, triangles have
/// three votes.
std::vector<StarTriangle> star_triangles(const CoverPoints& points, const SurfaceWalk& walk,
                                         double longest);

/// Whether the surface runs on along the segment between two points, a little inside where they
/// stand on a crease.
bool linked(const CoverPoint& a, const CoverPoint& b, const SurfaceWalk& walk);

}  // namespace isolux
