#pragma once

#include "isolux/core/vec3.h"

namespace isolux {

/// The line origin + t direction. The direction need not have length 1; t counts in its lengths.
struct Ray {
  Vec3 origin;
  Vec3 direction;

  Vec3 at(double t) const { return origin + direction * t; }
};

}  // namespace isolux
