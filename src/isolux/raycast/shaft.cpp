#include "isolux/raycast/shaft.h"

namespace isolux {
namespace {

/// The largest a·p + b·q over the box, p and q being the coordinates other than `axis`.
double farthest(const Bounds& box, int axis, double a, double b) {
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  return a * (a > 0 ? box.upper[p] : box.lower[p]) + b * (b > 0 ? box.upper[q] : box.lower[q]);
}

}  // namespace

Shaft::Shaft(const Bounds& from, const Bounds& to) : bounds_(from) {
  bounds_.include(to);
  // Seen along each axis, the hull's sides run between like corners of the two rectangles.
  std::size_t n = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int p = (axis + 1) % 3, q = (axis + 2) % 3;
    for (const bool p_upper : {false, true}) {
      for (const bool q_upper : {false, true}) {
        const double dp = (p_upper ? to.upper[p] - from.upper[p] : to.lower[p] - from.lower[p]);
        const double dq = (q_upper ? to.upper[q] - from.upper[q] : to.lower[q] - from.lower[q]);
        for (const double sign : {1.0, -1.0}) {
          const double a = sign * dq, b = -sign * dp;
          sides_[n++] = {axis, a, b,
                         std::max(farthest(from, axis, a, b), farthest(to, axis, a, b))};
        }
      }
    }
  }
}

bool Shaft::misses(const Bounds& box) const {
  if (!bounds_.overlaps(box)) return true;
  for (const Side& side : sides_) {
    const double nearest = -farthest(box, side.axis, -side.a, -side.b);
    if (nearest >= side.limit && (side.a != 0 || side.b != 0)) return true;
  }
  return false;
}

}  // namespace isolux
