#pragma once

#include "isolux/core/vec3.h"

namespace isolux {

/// A control point (m) of a rational curve or surface, and its weight, more than 0.
struct ControlPoint {
  Vec3 place;
  double weight = 1;
};

/// The point (1 − t) a + t b in homogeneous coordinates, t from 0 to 1. It is a itself for 0, b for
/// 1, and at their place for all t where they share it.
inline ControlPoint between(const ControlPoint& a, const ControlPoint& b, double t) {
  const double of_a = (1 - t) * a.weight, of_b = t * b.weight, weight = of_a + of_b;
  const Vec3 way = b.place - a.place;
  return {of_a > of_b ? a.place + way * (of_b / weight) : b.place - way * (of_a / weight), weight};
}

}  // namespace isolux
