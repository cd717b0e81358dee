#pragma once

#include "isolux/geometry/shape.h"

namespace isolux {

/// Triangles that come near to a shape.
struct Approximation {
  TriangleSoup soup;
  double deviation = 0;  ///< m, how far they are from the true surface at most, as measured
  double lost = 0;       ///< m, parts thinner than this may be missing; 0 where none are
};

/// Those of Shape::triangulate, or where it has none, of dual contouring on a grid (Ju, Losasso,
/// Schaefer and Warren 2002) of 32 cells along the shape's longest side, 64 where that is too
/// coarse for thin parts; it keeps edges and corners, but needs a surface that encloses a volume.
/// They have the sides of the shape. Throws InputError where there are more than 10⁶.
Approximation approximate(const Shape& shape, double max_edge);

}  // namespace isolux
