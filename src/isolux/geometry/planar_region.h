#pragma once

#include "isolux/core/vec3.h"
#include "isolux/geometry/ear_clipping.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// What a polygon encloses in its plane: 3 to 1000 corners (m), which may be concave and have
/// holes. Its normal is the one about which the corners run counter-clockwise; those of a hole may
/// run either way. It must be simple: edges meet at shared corners only, holes lie inside and not
/// in one another; corners in the middle of a straight side are fine. Corners may lie off the plane
/// by 1e-6 of the polygon's size, and are moved onto it. Messages number the corners of the holes
/// on from those of the outline.
struct PlanarRegion {
  /// Throws InputError where the corners enclose no such region.
  PlanarRegion(const std::vector<Vec3>& outline, const std::vector<std::vector<Vec3>>& holes);

  /// The place of a point in the frame about `center`; its z is zero.
  Vec3 flatten(const Vec3& point) const {
    return {dot(point - center, frame.u), dot(point - center, frame.v), 0};
  }

  Vec3 center;
  Frame frame{Vec3{0, 0, 1}};
  Bounds bounds;
  double slack = 0;         ///< m, what counts as zero distance
  TriangleSoup soup;        ///< the corners, and the triangles of ear clipping (Meisters 1975)
  Flat corners;             ///< the same corners in the frame
  std::vector<Ring> rings;  ///< the outline counter-clockwise, the holes clockwise
};

/// Whether q lies within the rings: a line from there leaves them an odd number of times.
bool encloses(const Flat& corners, const std::vector<Ring>& rings, const Vec3& q);

}  // namespace isolux
