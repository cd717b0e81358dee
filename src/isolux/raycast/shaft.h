#pragma once

#include <array>

#include "isolux/core/vec3.h"

namespace isolux {

/// All straight ways from one box to another: their convex hull (Haines & Wallace 1991).
class Shaft {
 public:
  Shaft(const Bounds& from, const Bounds& to);

  /// The box around it.
  const Bounds& bounds() const { return bounds_; }

  /// Whether the box surely has no point inside the shaft; tests the shaft's sides, each parallel
  /// to one of the axes.
  bool misses(const Bounds& box) const;

 private:
  /// A side of the hull: no point of the shaft has a·p + b·q > limit, p and q being the coordinates
  /// other than `axis`.
  struct Side {
    int axis;
    double a, b, limit;
  };
  Bounds bounds_;
  std::array<Side, 24> sides_;
};

}  // namespace isolux
