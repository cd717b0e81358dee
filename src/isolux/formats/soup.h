#pragma once

#include <memory>

#include "isolux/geometry/shape.h"

namespace isolux {

/// How many triangles were left out of a soup.
struct LeftOut {
  std::size_t flat = 0;      ///< without area
  std::size_t repeated = 0;  ///< between the same points as another
};

/// What cutting polygons took so far.
struct Cutting {
  double corner_pairs = 0;    ///< of polygons with more than four corners: the effort
  std::size_t uncertain = 0;  ///< polygons that cross themselves, or nearly so, and became fans
};

/// Adds the polygon between `corners`, which index the soup's points (each finite): cut along its
/// shorter diagonal where it has four corners, else by ear clipping in its mean plane, or as a fan
/// where that finds no way. Throws InputError where the effort gets too large.
void add_polygon(TriangleSoup& soup, const std::vector<std::uint32_t>& corners, Cutting& cutting);

/// Makes the soup one that a TriangleMesh can have. Points that are closer than 1e-7 of the soup's
/// size become one, so that neighbours are known as such; triangles that are left without area, or
/// repeat another (wound either way), and unused points are left out.
LeftOut weld(TriangleSoup& soup);

/// Turns triangles over such that neighbours, two at a common edge, run along it in opposite
/// directions wherever that is possible. Pieces of the surface that agree already stay as they are.
/// The first triangle of any other piece stays as it is; where the piece is closed, it is made to
/// face outward. Points at the same place are one (see weld()).
void agree(TriangleSoup& soup);

/// The mesh of a welded soup. With `two_sided`, its winding says nothing: neighbours are made to
/// agree, and what is closed to face outward. Throws InputError where a point is too far away.
std::shared_ptr<const Shape> mesh_of(TriangleSoup soup, bool two_sided);

}  // namespace isolux
