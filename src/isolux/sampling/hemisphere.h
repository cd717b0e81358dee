#pragma once

#include <vector>

#include "isolux/core/random.h"
#include "isolux/core/vec3.h"

namespace isolux {

/// Unit directions over the hemisphere around `frame.n`, jittered within grid × grid cells of equal
/// solid angle (§4.1).
std::vector<Vec3> uniform_hemisphere(const Frame& frame, int grid, Random& random);

/// Unit directions with a density proportional to the cosine from `frame.n`: points of the square
/// jittered within grid × grid cells, those on the unit disk lifted to the hemisphere (§4.2, after
/// Malley 1988); about π/4 grid² of them.
std::vector<Vec3> malley_hemisphere(const Frame& frame, int grid, Random& random);

}  // namespace isolux
