#include "isolux/radiosity/pairing.h"

#include <algorithm>
#include <tuple>

namespace isolux {

void pair_by_distance(const Triangulation& mesh, std::span<const SurfaceHit> scene_hits,
                      std::span<const MeshHit> mesh_hits, double tolerance,
                      std::vector<HitPair>& pairs) {
  struct Candidate {
    double gap;
    int scene, mesh;
  };
  thread_local std::vector<Candidate> candidates;
  candidates.clear();
  for (int i = 0; i < static_cast<int>(scene_hits.size()); ++i) {
    for (int j = 0; j < static_cast<int>(mesh_hits.size()); ++j) {
      const double gap = std::abs(scene_hits[i].t - mesh_hits[j].t);
      if (gap > tolerance * scene_hits[i].t) continue;
      const Vec3& facing = mesh.triangle(mesh_hits[j].triangle).normal;
      if (dot(facing, scene_hits[i].normal) > 0) candidates.push_back({gap, i, j});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.gap, a.scene, a.mesh) < std::tie(b.gap, b.scene, b.mesh);
  });

  pairs.assign(scene_hits.size(), HitPair{});
  thread_local std::vector<char> taken;
  taken.assign(mesh_hits.size(), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].scene = static_cast<int>(i);
  for (const Candidate& c : candidates) {
    if (pairs[c.scene].mesh >= 0 || taken[c.mesh]) continue;
    pairs[c.scene].mesh = c.mesh;
    taken[c.mesh] = 1;
  }
  for (std::size_t j = 0; j < mesh_hits.size(); ++j) {
    if (!taken[j]) pairs.push_back({-1, static_cast<int>(j)});
  }
}

}  // namespace isolux
