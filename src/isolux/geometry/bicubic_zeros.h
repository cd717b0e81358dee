#pragma once

#include <vector>

#include "isolux/geometry/bicubic.h"

namespace isolux {

/// A place on a patch: its parameters, from 0 to 1.
struct Place {
  double u, v;
};

/// Two polynomials of which, on [0, 1]², x rises about as u does, and y as v:
/// |∂x/∂u − 1| + |∂x/∂v| ≤ deviation < 1, and likewise y. They have one common zero at most.
struct NearIdentity {
  static constexpr double kMost = 0.8;  ///< of the deviation, for the search to be short

  Bicubic x, y;
  double deviation;
  double slack_x, slack_y;  ///< what still counts as zero

  enum class Zeros { none, one, unknown };
  /// Looks for the zero from `place` on, and leaves it there. `unknown` after too many steps.
  Zeros search(Place& place) const;
};

/// How uneven the slopes of such polynomials are in a way that halving along that axis mends.
double unevenness(const Bicubic& x, const Bicubic& y, int axis);

/// How far along a line a patch is.
struct Depth {
  Bicubic scaled;  ///< times the weight
  Bicubic weight;  ///< more than 0

  double at(const Place& place) const;
};

/// How far from 0 a polynomial may be that counts as zero, where patches are about of size 1.
inline constexpr double kHair = 1e-14;
/// Of the angle between a line and a patch: at smaller ones the line counts as within it.
inline constexpr double kLeastSine = 1e-12;

/// Adds the places where a and b, the distances of a patch off a line in two directions, are zero;
/// all of them, each once. Where the line runs within the patch, some or none. `depth` is along
/// the line, in the same unit.
///
/// Pieces of the patch whose control points show that there is none are dropped, those that have
/// one at most are searched by Newton's method, all others halved (subdivision with the convex
/// hull, as in Nishita, Sederberg and Kakimoto 1990).
void add_common_zeros(const Bicubic& a, const Bicubic& b, const Depth& depth,
                      std::vector<Place>& places);

}  // namespace isolux
