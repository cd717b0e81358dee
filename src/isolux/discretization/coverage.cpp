#include "isolux/discretization/coverage.h"

#include <numbers>

#include "isolux/core/parallel.h"
#include "isolux/discretization/light_reach.h"
#include "isolux/discretization/mesh_rays.h"
#include "isolux/sampling/lines.h"

namespace isolux {
namespace {

constexpr std::size_t kGrain = 256;
// A triangle lies over a point within this part of δ from it along the normal: facets whose corners
// turn by α_n = 30° bulge by 7 % of a side.
constexpr double kOver = 0.1;

}  // namespace

Coverage coverage_of(const Triangulation& mesh, const RayCaster& rays, int lines,
                     std::uint64_t seed) {
  const Bounds bounds = rays.scene().bounds();
  const double radius = 0.5 * bounds.diagonal(), reach = kOver * mesh.rules().max_edge;
  const MeshRays mesh_rays(mesh);
  const SurfaceWalk walk(rays, mesh.rules().normal_tolerance);
  const LightReach light(walk, seed);
  struct Count {
    std::size_t hits = 0, covered = 0;
  };
  const auto n = static_cast<std::size_t>(std::max(lines, 0));
  std::vector<Count> counts((n + kGrain - 1) / kGrain);
  parallel_for(n, kGrain, [&](std::size_t begin, std::size_t end) {
    Count& count = counts[begin / kGrain];
    std::vector<SurfaceHit> hits;
    std::vector<MeshHit> over;
    for (std::size_t i = begin; i < end; ++i) {
      Random random(seed, i);
      const Line line = random_line(bounds.center(), radius, random);
      rays.all_hits({line.point - line.direction * (1.01 * radius), line.direction}, {}, hits);
      for (const SurfaceHit& hit : hits) {
        const auto point = walk.at(hit);
        if (!point || !light.reaches(*point, random)) continue;
        const auto beside = light.beside(*point, random);
        if (beside && !light.reaches(*beside, random)) continue;
        ++count.hits;
        mesh_rays.all_hits({hit.point + hit.normal * reach, -hit.normal}, {0, 2 * reach}, over);
        count.covered += std::any_of(over.begin(), over.end(), [&](const MeshHit& m) {
          return dot(mesh.triangle(m.triangle).normal, hit.normal) > 0;
        });
      }
    }
  });
  Count sum;
  for (const Count& count : counts) sum.hits += count.hits, sum.covered += count.covered;
  const double area_per_hit =
      n > 0 ? 2 * std::numbers::pi * radius * radius / static_cast<double>(n) : 0;
  return {area_per_hit * static_cast<double>(sum.hits),
          area_per_hit * static_cast<double>(sum.covered)};
}

}  // namespace isolux
