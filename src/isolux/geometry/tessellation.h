#pragma once

#include <functional>

#include "isolux/geometry/shape.h"

namespace isolux {

// How shapes are cut into triangles. All functions throw InputError where more than kMostTriangles
// would come out, or max_edge is not greater than 0.

inline constexpr double kMostTriangles = 1e6;

/// Throws where `count` is too many.
void require_few_triangles(double count);

/// The number of equal pieces, at least 1, no longer than max_edge, that `length` is cut into.
double piece_count(double length, double max_edge);

/// The number of segments, a multiple of 4 and at least 32, for a circle of that radius.
double circle_segments(double radius, double max_edge);

/// nu × nv cells, each two triangles cut along the shorter diagonal, whose corners are
/// point(i / nu, j / nv); they face along ∂point/∂u × ∂point/∂v. With `closed`, u = 1 is u = 0.
/// Triangles that shrink to a line are left out.
TriangleSoup grid(double nu, double nv, bool closed,
                  const std::function<Vec3(double, double)>& point);

/// A disk, or annulus where inner > 0, that faces along the unit vector `normal`, with the given
/// number of segments (a multiple of 4); scaled about its centre to have the true area.
TriangleSoup disk_triangles(const Vec3& center, const Vec3& normal, double radius, double inner,
                            double segments, double max_edge);

/// Halves every edge longer than max_edge until there are none, without leaving a vertex inside
/// an edge of a neighbour; `project` moves each new vertex onto the surface.
void subdivide(TriangleSoup& soup, double max_edge,
               const std::function<Vec3(const Vec3&)>& project = nullptr);

/// Adds the points and triangles of `from`, sharing none.
void append(TriangleSoup& to, const TriangleSoup& from);

/// Turns every triangle over.
void flip(TriangleSoup& soup);

double area(const TriangleSoup& soup);

/// Scales the soup about `center` so that its area becomes `wanted`.
void scale_to_area(TriangleSoup& soup, const Vec3& center, double wanted);

}  // namespace isolux
