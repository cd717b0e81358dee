#pragma once

#include <span>
#include <vector>

#include "isolux/discretization/mesh_rays.h"
#include "isolux/discretization/triangulation.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// A scene intersection I_s and a discretization intersection I_d of one ray that stand for the
/// same place; −1 marks a dummy intersection (§3.2.3).
struct HitPair {
  int scene = -1;
  int mesh = -1;
};

/// Merges the two lists pairwise by distance: the closest pairs first, none farther apart than
/// `tolerance` × the distance from the ray's origin, and only where triangle and surface face the
/// same way. The pairs come in the order of the scene hits, then the mesh hits left alone.
void pair_by_distance(const Triangulation& mesh, std::span<const SurfaceHit> scene_hits,
                      std::span<const MeshHit> mesh_hits, double tolerance,
                      std::vector<HitPair>& pairs);

}  // namespace isolux
