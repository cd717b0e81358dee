#include "isolux/discretization/mesh_rays.h"

#include <gtest/gtest.h>

#include "isolux/core/random.h"
#include "isolux/raycast/triangle_tree.h"

namespace isolux {
namespace {

/// A triangulation of the unit square, grown by random points.
class GrowingSquare {
 public:
  GrowingSquare() : mesh({0.3, 1e-6, 0.5}, {{0, 0, 0}, {1, 1, 1}}) {}
  void grow(int points) {
    for (int i = 0; i < points; ++i) {
      mesh.extend({{random.uniform(), random.uniform(), 0}, {0, 0, 1}, {0, 0}, gray(0.5)});
    }
  }
  Triangulation mesh;
  Random random{9};
};

TEST(MeshRays, FindTheSameTrianglesWhetherInTheTreeOrNewborn) {
  GrowingSquare square;
  MeshRays rays(square.mesh);
  Random random(2);
  std::vector<MeshHit> hits;
  for (int round = 0; round < 30; ++round) {
    square.grow(60);
    if (round % 3 != 0) rays.update();
    for (std::size_t t = round; t < square.mesh.triangles().size(); t += 97) {
      square.mesh.remove(static_cast<TriangleId>(t));
    }
    for (int i = 0; i < 50; ++i) {
      const Vec3 from{random.uniform(), random.uniform(), random.uniform()};
      const Ray ray{from, Vec3{random.uniform(), random.uniform(), 0} - from};
      rays.all_hits(ray, {}, hits);
      std::size_t expected = 0;
      for (TriangleId t = 0; t < square.mesh.triangles().size(); ++t) {
        const auto& v = square.mesh.triangle(t).vertices;
        const std::optional<double> at = intersect_triangle(
            {square.mesh.vertex(v[0]).position, square.mesh.vertex(v[1]).position,
             square.mesh.vertex(v[2]).position},
            ray);
        expected += square.mesh.triangle(t).alive && at && *at > 0;
      }
      EXPECT_EQ(hits.size(), expected);
      EXPECT_LE(hits.size(), 1u) << "triangles of a plane do not overlap";
      for (const MeshHit& hit : hits) EXPECT_NEAR(hit.t, 1, 1e-12);
    }
  }
}

TEST(MeshRays, HitsSinceLeavesOlderTrianglesOut) {
  GrowingSquare square;
  square.grow(100);
  MeshRays rays(square.mesh);
  const auto born = static_cast<TriangleId>(square.mesh.triangles().size());
  square.grow(100);
  std::vector<MeshHit> all, since;
  for (int i = 0; i < 200; ++i) {
    const Ray ray{{0.1 + 0.004 * i, 0.5, 1}, {0, 0, -1}};
    rays.all_hits(ray, {}, all);
    since.clear();
    rays.hits_since(born, ray, {}, since);
    const auto young = std::count_if(all.begin(), all.end(),
                                     [&](const MeshHit& hit) { return hit.triangle >= born; });
    EXPECT_EQ(static_cast<std::ptrdiff_t>(since.size()), young);
  }
}

TEST(MeshRays, ManyRaysFindWhatEachFinds) {
  GrowingSquare square;
  square.grow(300);
  MeshRays rays(square.mesh);
  square.grow(50);
  for (TriangleId t = 0; t < square.mesh.triangles().size(); t += 7) square.mesh.remove(t);
  std::vector<Ray> bundle;
  for (int i = 0; i < 40; ++i) bundle.push_back({{0.1 + 0.02 * i, 0.5, 1}, {0.1, 0.2, -1}});
  std::vector<std::vector<MeshHit>> together(bundle.size());
  rays.all_hits(bundle, {}, together);
  std::vector<MeshHit> alone;
  for (std::size_t i = 0; i < bundle.size(); ++i) {
    rays.all_hits(bundle[i], {}, alone);
    ASSERT_EQ(together[i].size(), alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k) {
      EXPECT_EQ(together[i][k].triangle, alone[k].triangle);
      EXPECT_EQ(together[i][k].t, alone[k].t);
    }
  }
}

}  // namespace
}  // namespace isolux
