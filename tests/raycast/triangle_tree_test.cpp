#include "isolux/raycast/triangle_tree.h"

#include <gtest/gtest.h>

#include "isolux/core/random.h"

namespace isolux {
namespace {

Vec3 random_point(Random& random) { return {random.uniform(), random.uniform(), random.uniform()}; }

TriangleTree tree_of(const std::vector<TriangleCorners>& triangles) {
  TriangleSoup soup;
  for (const TriangleCorners& corners : triangles) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    soup.points.insert(soup.points.end(), corners.begin(), corners.end());
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return TriangleTree(soup);
}

TEST(TriangleTree, FindsWhatEachTriangleFindsByItself) {
  Random random(3);
  std::vector<TriangleCorners> triangles;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random_point(random);
    triangles.push_back({p, p + random_point(random) * 0.2, p + random_point(random) * 0.2});
  }
  const TriangleTree tree = tree_of(triangles);
  std::vector<TriangleHit> hits;
  int differing = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 from = random_point(random);
    const Ray ray{from, random_point(random) - from};
    tree.all_hits({&ray, 1}, {}, {&hits, 1});
    std::vector<std::uint8_t> found(triangles.size(), 0);
    for (const TriangleHit& hit : hits) {
      found[hit.triangle] = 1;
      const std::optional<double> alone = intersect_triangle(triangles[hit.triangle], ray);
      if (alone) {
        EXPECT_NEAR(hit.t, *alone, 1e-9 * (1 + *alone));
      }
    }
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const std::optional<double> alone = intersect_triangle(triangles[k], ray);
      const bool meets = alone && *alone > 0;
      if (meets != (found[k] != 0)) ++differing;
    }
  }
  // Only rays along a side, to within single precision, may differ: a handful in 2.5 million.
  EXPECT_LE(differing, 5);
}

TEST(TriangleTree, LetsNoRayThroughBetweenNeighbours) {
  // A fan around a point; rays are aimed exactly at its inner sides.
  constexpr int kBlades = 12;
  std::vector<TriangleCorners> fan;
  std::vector<Vec3> rim;
  for (int i = 0; i <= kBlades; ++i)
    rim.push_back({std::cos(i * 0.523598776), std::sin(i * 0.523598776), 0});
  for (int i = 0; i < kBlades; ++i) fan.push_back({Vec3{0, 0, 0}, rim[i], rim[i + 1]});
  const TriangleTree tree = tree_of(fan);
  Random random(5);
  std::vector<TriangleHit> hits;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 target = rim[random.below(kBlades)] * random.uniform() * 0.99;
    const Vec3 from = random_point(random) + Vec3{0, 0, 1};
    const Ray ray{from, target - from};
    tree.all_hits({&ray, 1}, {}, {&hits, 1});
    ASSERT_GE(hits.size(), 1u) << "ray " << i;
  }
}

TEST(TriangleTree, MayBeEmpty) {
  const TriangleTree tree({});
  std::vector<TriangleHit> hits;
  const Ray ray{{0, 0, 0}, {1, 2, 3}};
  tree.all_hits({&ray, 1}, {}, {&hits, 1});
  EXPECT_TRUE(hits.empty());
}

}  // namespace
}  // namespace isolux
