#include "isolux/radiosity/pairing.h"

#include <gtest/gtest.h>

namespace isolux {
namespace {

const Vec3 kUp{0, 0, 1};

/// A triangulation with one large triangle in the plane z = `height`, seen from above.
Triangulation triangle_at(double height, const Vec3& normal = kUp) {
  Triangulation mesh({4, 1e-4, 0.5}, {{-2, -2, -2}, {2, 2, 2}});
  for (const auto& [x, y] : {std::pair(-1., -1.), {1., -1.}, {0., 1.}}) {
    mesh.extend({{x, y, height}, normal, {0, 0}, gray(0.5)});
  }
  EXPECT_EQ(mesh.triangle_count(), 1u);
  return mesh;
}

SurfaceHit hit_at(double t, const Vec3& normal = kUp) { return {t, {0, 0, 1 - t}, normal, {}}; }

TEST(Pairing, TakesTheClosestFirst) {
  const Triangulation mesh = triangle_at(0);
  const SurfaceHit scene[] = {hit_at(0.99), hit_at(1.005)};
  const MeshHit mesh_hits[] = {{1.0, 0}, {1.001, 0}};
  std::vector<HitPair> pairs;
  pair_by_distance(mesh, scene, mesh_hits, 0.02, pairs);
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[1].mesh, 1) << "1.001 is nearest to 1.005";
  EXPECT_EQ(pairs[0].mesh, 0);
}

TEST(Pairing, LeavesDummiesWhereTheOtherListHasNothingNear) {
  const Triangulation mesh = triangle_at(0);
  const SurfaceHit scene[] = {hit_at(0.5), hit_at(2)};
  const MeshHit mesh_hits[] = {{1.0, 0}, {2.01, 0}};
  std::vector<HitPair> pairs;
  pair_by_distance(mesh, scene, mesh_hits, 0.02, pairs);
  ASSERT_EQ(pairs.size(), 3u);
  EXPECT_EQ(pairs[0].mesh, -1) << "extend";
  EXPECT_EQ(pairs[1].mesh, 1) << "refine";
  EXPECT_EQ(pairs[2].scene, -1) << "remove";
  EXPECT_EQ(pairs[2].mesh, 0);
}

TEST(Pairing, TheToleranceGrowsWithTheDistance) {
  const Triangulation mesh = triangle_at(0);
  std::vector<HitPair> pairs;
  for (double t : {0.1, 1.0, 10.0}) {
    const SurfaceHit scene[] = {hit_at(t)};
    const MeshHit near[] = {{t * 1.019, 0}}, far[] = {{t * 1.021, 0}};
    pair_by_distance(mesh, scene, near, 0.02, pairs);
    EXPECT_EQ(pairs[0].mesh, 0) << t;
    pair_by_distance(mesh, scene, far, 0.02, pairs);
    EXPECT_EQ(pairs[0].mesh, -1) << t;
  }
}

// Figure 1: a ledge stands a little above a floor that has a triangle; the ledge has none yet. By
// distance alone, its hit is paired with the triangle of the floor.
TEST(Pairing, FalsePairingOfFigure1HappensOnlyAsLongAsTheFloorIsNotHitToo) {
  const Triangulation mesh = triangle_at(0);
  const MeshHit floor_triangle[] = {{1.0, 0}};
  std::vector<HitPair> pairs;

  // First hits only, as in the figure: the ledge at 0.99 takes the floor's triangle.
  const SurfaceHit ledge[] = {hit_at(0.99)};
  pair_by_distance(mesh, ledge, floor_triangle, 0.02, pairs);
  EXPECT_EQ(pairs[0].mesh, 0) << "the heuristic is wrong here, as the paper says";

  // With all hits along the ray the floor itself is nearer, and the ledge is left to be extended.
  const SurfaceHit ledge_and_floor[] = {hit_at(0.99), hit_at(1.0)};
  pair_by_distance(mesh, ledge_and_floor, floor_triangle, 0.02, pairs);
  EXPECT_EQ(pairs[0].mesh, -1);
  EXPECT_EQ(pairs[1].mesh, 0);

  // The underside of the ledge faces away and is never mistaken for the floor.
  const SurfaceHit underside[] = {hit_at(1.0, -kUp)};
  pair_by_distance(mesh, underside, floor_triangle, 0.02, pairs);
  EXPECT_EQ(pairs[0].mesh, -1);
}

}  // namespace
}  // namespace isolux
