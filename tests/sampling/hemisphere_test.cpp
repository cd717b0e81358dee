#include "isolux/sampling/hemisphere.h"

#include <gtest/gtest.h>

namespace isolux {
namespace {

const Frame kTilted(normalized(Vec3{1, 2, -2}));

struct Moments {
  double cosine = 0, cosine_squared = 0;
  Vec3 sum;
};

Moments moments_of(const std::vector<Vec3>& directions) {
  Moments m;
  for (const Vec3& d : directions) {
    EXPECT_NEAR(length(d), 1, 1e-12);
    EXPECT_GT(dot(d, kTilted.n), 0);
    m.cosine += dot(d, kTilted.n);
    m.cosine_squared += dot(d, kTilted.n) * dot(d, kTilted.n);
    m.sum += d;
  }
  const auto n = static_cast<double>(directions.size());
  return {m.cosine / n, m.cosine_squared / n, m.sum / n};
}

TEST(Hemisphere, UniformDirectionsHaveTheMomentsOfAUniformDensity) {
  Random random(1);
  const auto directions = uniform_hemisphere(kTilted, 100, random);
  EXPECT_EQ(directions.size(), 10000u);
  const Moments m = moments_of(directions);
  EXPECT_NEAR(m.cosine, 1. / 2, 2e-3);
  EXPECT_NEAR(m.cosine_squared, 1. / 3, 2e-3);
  EXPECT_NEAR(distance(m.sum, kTilted.n * 0.5), 0, 3e-3);
}

TEST(Hemisphere, MalleysDirectionsHaveTheMomentsOfACosineDensity) {
  Random random(1);
  const auto directions = malley_hemisphere(kTilted, 100, random);
  EXPECT_NEAR(static_cast<double>(directions.size()), 7854, 80);
  const Moments m = moments_of(directions);
  EXPECT_NEAR(m.cosine, 2. / 3, 2e-3);
  EXPECT_NEAR(m.cosine_squared, 1. / 2, 2e-3);
  EXPECT_NEAR(distance(m.sum, kTilted.n * (2. / 3)), 0, 3e-3);
}

TEST(Hemisphere, TheSameSeedGivesTheSameRaysAndAnotherSeedOthers) {
  Random a(4), b(4), c(5);
  const auto first = malley_hemisphere(kTilted, 8, a);
  EXPECT_EQ(first, malley_hemisphere(kTilted, 8, b));
  EXPECT_NE(first, malley_hemisphere(kTilted, 8, c));
}

}  // namespace
}  // namespace isolux
