#pragma once

#include "isolux/core/random.h"
#include "isolux/core/vec3.h"

namespace isolux {

/// A straight line: unit direction, and a point on it.
struct Line {
  Vec3 point;
  Vec3 direction;
};

/// A line of the invariant measure of lines, given that it meets the sphere; `point` is the middle
/// of the chord. It crosses a surface of area A inside the sphere A / (2π radius²) times on
/// average, wherever and however that lies (Crofton).
Line random_line(const Vec3& center, double radius, Random& random);

}  // namespace isolux
