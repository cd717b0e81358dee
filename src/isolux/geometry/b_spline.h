#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "isolux/geometry/control_point.h"

namespace isolux {

/// The knots of a B-spline. From one to the next it is one polynomial of that degree; at a knot
/// that comes k times, its derivatives go on up to number degree − k. It begins at knot number
/// degree + 1, and ends at the last but `degree`.
struct KnotVector {
  std::size_t degree;         ///< 1 to 3
  std::vector<double> knots;  ///< never falling, degree + 1 more than control points
};

/// Throws InputError, with one line that begins with `what`, where these are no knots of as many
/// points. Within the curve a knot comes `degree` times at most, else once more.
void require_knots(const KnotVector& vector, std::size_t points, std::string_view what);

/// The number of polynomials that the curve consists of.
std::size_t arc_count(const KnotVector& vector);

/// The same curve as cubic Bézier arcs, each from the last point of the one before: three control
/// points for each arc, and one.
///
/// They are what inserting knots leads to (Boehm 1980), found by the blossom (Ramshaw 1987), with
/// the degree raised to 3: means of the given points, so that no digits get lost.
std::vector<ControlPoint> cubic_arcs(const KnotVector& vector,
                                     const std::vector<ControlPoint>& points);

}  // namespace isolux
