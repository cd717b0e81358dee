#pragma once

#include <memory>
#include <vector>

#include "isolux/geometry/shape.h"

namespace isolux {

using Contour = std::vector<Vec3>;  ///< corners, m

/// A region bounded by its outline and those of its holes, which run the other way.
struct Region {
  Contour outline;
  std::vector<Contour> holes;
};

/// The region that a contour encloses. Seams, passed there and back, are dissolved: they connect
/// the outlines of holes. No outline where nothing is enclosed. Throws InputError where the region
/// falls apart or has more than 1000 corners.
Region without_seams(const Contour& contour);

/// The surface of a region, facing the side from which its outline runs counter-clockwise: a
/// polygon or, where its corners don't lie in a plane, flat triangles between them. Null where it
/// has no area.
std::shared_ptr<const Shape> face_shape(const Region& region);

/// Whether the corners lie in a plane, as well as face_shape() asks.
bool is_flat(const Region& region);

/// Twice the area of a contour, along its normal (Newell).
Vec3 doubled_area(const Contour& contour);

}  // namespace isolux
