#pragma once

#include <cstdint>
#include <functional>

#include "isolux/discretization/triangulation.h"

namespace isolux {

struct CoverOptions {
  double spacing = 0.1;    ///< m: between neighbours on flat surfaces far from anything
  std::uint64_t seed = 1;  ///< of the random lines and of the points' places
  /// Asked every hundred points or so, after some thousands of them; once it says no, only what has
  /// points is covered.
  std::function<bool()> keep_going = {};
};

/// Covers every surface that light can reach with triangles, before there is any light: what random
/// lines through the whole scene and through each object meet, what cameras see, and all that
/// adjoins it; lights included, whose triangles get their emission but are otherwise like all
/// others. Edges run within one smooth surface of one zone (SurfaceWalk); vertices along creases
/// stand a thousandth of their distance inside. Sizes go down to where neighbours' normals are
/// within α_n, to twice the width of narrow strips, and along round creases; they grow by half a
/// metre a metre. Where LightReach finds no light, a patch ends in a border of vertices. On thin
/// surfaces that are straight in one direction, triangles are long along it.
/// All ids stay valid. Throws InputError where the spacing is not positive. Cost: linear in the
/// vertices made, some 50 rays for each, and in the number of objects.
void cover(Triangulation& mesh, const RayCaster& rays, const CoverOptions& options);

}  // namespace isolux
