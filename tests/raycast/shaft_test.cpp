#include "isolux/raycast/shaft.h"

#include <gtest/gtest.h>

#include "isolux/core/random.h"
#include "isolux/raycast/ray_caster.h"
#include "support/scenes.h"

namespace isolux {
namespace {

Vec3 random_point(Random& random) { return {random.uniform(), random.uniform(), random.uniform()}; }

Bounds random_box(Random& random, double size) {
  Bounds box;
  const Vec3 corner = random_point(random);
  box.include(corner), box.include(corner + random_point(random) * size);
  return box;
}

Vec3 point_in(const Bounds& box, Random& random) {
  const Vec3 s = box.upper - box.lower, r = random_point(random);
  return box.lower + Vec3{s.x * r.x, s.y * r.y, s.z * r.z};
}

TEST(Shaft, MissesNoBoxThatAWayGoesThrough) {
  Random random(1);
  int missed = 0;
  for (int i = 0; i < 2000; ++i) {
    const Bounds from = random_box(random, 0.2), to = random_box(random, 0.2);
    const Shaft shaft(from, to);
    const Bounds between = random_box(random, 0.2);
    if (shaft.misses(between)) {
      ++missed;
      for (int k = 0; k < 50; ++k) {
        const Vec3 a = point_in(from, random), b = point_in(to, random);
        for (double s = 0.01; s < 1; s += 0.07) {
          const Vec3 p = a + (b - a) * s;
          Bounds point;
          point.include(p);
          EXPECT_FALSE(between.encloses(point));
        }
      }
    }
    EXPECT_FALSE(shaft.misses(from)) << "it contains its ends";
  }
  EXPECT_GT(missed, 1000) << "most boxes are out of the way";
}

TEST(Shaft, ClearMeansThatNoSegmentIsOccluded) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  Random random(2);
  int clear = 0;
  for (int i = 0; i < 2000; ++i) {
    Bounds from = random_box(random, 0.1), to = random_box(random, 0.1);
    from.upper = min(from.upper, {1, 1, 1}), to.upper = min(to.upper, {1, 1, 1});
    if (!rays.clear(from, to)) continue;
    ++clear;
    for (int k = 0; k < 20; ++k) {
      EXPECT_FALSE(rays.occluded(Segment{point_in(from, random), point_in(to, random)}));
    }
  }
  EXPECT_GT(clear, 500);
  const Bounds left{{0, 0.45, 0}, {0.1, 0.55, 0.1}}, right{{0.9, 0.45, 0}, {1, 0.55, 0.1}};
  EXPECT_FALSE(rays.clear(left, right)) << "the pedestal stands between";
}

}  // namespace
}  // namespace isolux
