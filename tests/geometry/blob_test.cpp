#include "isolux/geometry/blob.h"

#include <gtest/gtest.h>

#include <numbers>

#include "geometry/zoo.h"
#include "isolux/geometry/sphere.h"

namespace isolux {
namespace {

double field(const std::vector<BlobBall>& balls, const Vec3& p) {
  double sum = 0;
  for (const BlobBall& ball : balls) {
    const double d2 = length_squared(p - ball.center) / (ball.radius * ball.radius);
    if (d2 < 1) sum += ball.strength * (1 - d2) * (1 - d2);
  }
  return sum;
}

// One ball is a sphere: (1 − d²/R²)² = T at d = R √(1 − √T).
TEST(BlobTest, OneBallIsASphere) {
  const double radius = 2 * std::sqrt(1 - std::sqrt(0.25 / 1.5));
  const Blob blob(0.25, {{{1, 2, 3}, 2, 1.5}});
  const Sphere sphere({1, 2, 3}, radius);
  EXPECT_LT(distance(blob.bounds().lower, sphere.bounds().lower), 1e-14);
  EXPECT_LT(distance(blob.bounds().upper, sphere.bounds().upper), 1e-14);
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_line(random, {1, 2, 3}, 1.1 * radius, 5);
    const Hits a = hits_of(blob, ray), b = hits_of(sphere, ray);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      const double grazing = std::abs(dot(b[k].normal, ray.direction));
      EXPECT_LT(distance(a[k].point, b[k].point), 1e-13 / grazing);
      EXPECT_LT(distance(a[k].normal, b[k].normal), 1e-13 / grazing);
    }
  }
}

TEST(BlobTest, BallsOutOfReachOfEachOtherAreSpheres) {
  const Blob blob(0.6, {{{-0.9, 0, 0}, 1, 1}, {{0.9, 0, 0}, 1, 1}, {{4, 0, 0}, 1, 2}});
  const Hits hits = hits_of(blob, {{-10, 0, 0}, {2, 0, 0}});
  ASSERT_EQ(hits.size(), 6u);
  EXPECT_NEAR(hits[0].point.x, -0.9 - std::sqrt(1 - std::sqrt(0.6)), 1e-14);
  EXPECT_NEAR(hits[5].point.x, 4 + std::sqrt(1 - std::sqrt(0.3)), 1e-14);
  EXPECT_NEAR(hits[5].t, (10 + hits[5].point.x) / 2, 1e-14);
}

// Two balls at ± a on the axis, seen across their middle: 2 (1 − (a² + y²)/R²)² = T.
TEST(BlobTest, TheWaistBetweenTwoBalls) {
  const double a = 0.6, threshold = 0.2;
  const Blob blob(threshold, {{{-a, 0, 0}, 1, 1}, {{a, 0, 0}, 1, 1}});
  const Hits hits = hits_of(blob, {{0, -5, 0}, {0, 1, 0}});
  ASSERT_EQ(hits.size(), 2u);
  const double waist = std::sqrt(1 - std::sqrt(threshold / 2) - a * a);
  EXPECT_NEAR(hits[0].point.y, -waist, 1e-14);
  EXPECT_NEAR(hits[1].point.y, waist, 1e-14);
  EXPECT_LT(distance(hits[1].normal, {0, 1, 0}), 1e-14);
}

// Against small steps along the line: no crossing is missed, and each hit lies between two steps.
TEST(BlobTest, EveryCrossingIsFound) {
  constexpr int kSteps = 4000;
  Random random(5);
  std::size_t crossings = 0, most = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<BlobBall> balls;
    for (int i = 0; i < 14; ++i) {
      const Vec3 center = random_direction(random) * (2 * random.uniform());
      const double strength = i % 4 == 3 ? -1.5 * random.uniform() : 0.4 + random.uniform();
      balls.push_back({center, 0.3 + random.uniform(), strength});
    }
    const double threshold = 0.05 + 0.5 * random.uniform();
    const Blob blob(threshold, balls);
    for (int i = 0; i < 100; ++i) {
      const Ray ray = random_line(random, {}, 2, 4);
      const Hits hits = hits_of(blob, ray);
      ASSERT_EQ(hits.size() % 2, 0u);
      most = std::max(most, hits.size());
      std::size_t before = 0;
      for (int k = 1; k <= kSteps; ++k) {
        const double t = 8.0 * k / kSteps;
        std::size_t passed = before;
        while (passed < hits.size() && hits[passed].t < t) ++passed;
        const bool inside = field(balls, ray.at(t)) > threshold;
        const double margin = std::abs(field(balls, ray.at(t)) - threshold);
        if (margin > 1e-9) {
          ASSERT_EQ(passed % 2 == 1, inside) << "at t = " << t;
        }
        crossings += passed - before;
        before = passed;
      }
    }
  }
  EXPECT_GT(crossings, 4000u);
  EXPECT_GE(most, 6u);
}

// Four balls on a line of sight, each of which alone would be a hit more or less: whatever the
// threshold, hits alternate.
TEST(BlobTest, ThresholdsNearTheFieldsTurningPoints) {
  const std::vector<BlobBall> balls = {
      {{-1.2, 0, 0}, 1, 1}, {{0, 0, 0}, 1, 1}, {{1.2, 0, 0}, 1, 1}, {{2.4, 0, 0}, 1, 1}};
  for (int i = 1; i < 4000; ++i) {
    const Blob blob(i * 1e-3 * 0.3, balls);
    const Hits hits = hits_of(blob, {{-5, 0, 0}, {1, 0, 0}});
    ASSERT_EQ(hits.size() % 2, 0u);
    for (std::size_t k = 0; k < hits.size(); ++k) {
      EXPECT_EQ(hits[k].normal.x < 0, k % 2 == 0) << "threshold " << i * 3e-4;
    }
  }
}

// The mean chord of random lines gives the volume (4 V / A of the sphere they come from); the mean
// of contains() over the same sphere's ball gives it as well.
TEST(BlobTest, VolumeByLinesAndByPoints) {
  const std::vector<BlobBall> balls = {{{0.5, 0, 0}, 1, 1}, {{-0.5, 0, 0}, 1, 1}};
  const Blob blob(0.2, balls);
  constexpr int kCount = 100'000;
  const double radius = 1.5;
  Random random(9);
  double chords = 0;
  int within = 0;
  for (int i = 0; i < kCount; ++i) {
    const Hits hits = hits_of(blob, random_line(random, {}, radius, radius));
    for (std::size_t k = 0; k + 1 < hits.size(); k += 2) chords += hits[k + 1].t - hits[k].t;
    const Vec3 p = random_direction(random) * (radius * std::cbrt(random.uniform()));
    within += blob.contains(p);
  }
  const double by_lines = chords / kCount * std::numbers::pi * radius * radius;
  const double by_points = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3) * within / kCount;
  EXPECT_NEAR(by_lines, by_points, 0.03 * by_points);  // four standard errors
}

}  // namespace
}  // namespace isolux
