#include "isolux/core/affine.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "isolux/core/random.h"

namespace isolux {
namespace {

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_LE(distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

Affine random_map(Random& random) {
  const auto draw = [&] { return Vec3{random.uniform(), random.uniform(), random.uniform()}; };
  return Affine::translate(draw() * 10) * Affine::rotate(draw(), 6 * random.uniform()) *
         Affine::scale(draw() + Vec3{0.1, 0.1, 0.1});
}

TEST(Affine, QuarterTurnAboutZTakesXToY) {
  const Affine turn = Affine::rotate({0, 0, 5}, std::numbers::pi / 2);
  expect_near(turn.point({1, 0, 0}), {0, 1, 0}, 1e-15);
  expect_near(turn.point({0, 0, 2}), {0, 0, 2}, 1e-15);
}

TEST(Affine, ProductAppliesTheRightFactorFirst) {
  const Affine map = Affine::translate({1, 0, 0}) * Affine::scale({2, 2, 2});
  expect_near(map.point({1, 1, 1}), {3, 2, 2}, 0);
  expect_near(map.vector({1, 1, 1}), {2, 2, 2}, 0);
}

TEST(Affine, InverseUndoesTheMap) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Affine map = random_map(random);
    const auto inverse = map.inverse();
    ASSERT_TRUE(inverse);
    const Vec3 p{random.uniform(), random.uniform(), random.uniform()};
    expect_near(inverse->point(map.point(p)), p, 1e-12);
    EXPECT_NEAR(map.determinant() * inverse->determinant(), 1, 1e-12);
  }
}

TEST(Affine, InverseTransposedCarriesNormals) {
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Affine map = random_map(random);
    const Vec3 n = normalized({random.uniform(), random.uniform(), 1});
    const Frame frame(n);
    const Vec3 mapped = map.inverse()->transposed(n);
    EXPECT_NEAR(dot(mapped, map.vector(frame.u)), 0, 1e-11);
    EXPECT_NEAR(dot(mapped, map.vector(frame.v)), 0, 1e-11);
  }
}

TEST(Affine, SingularAndNonFiniteMapsHaveNoInverse) {
  EXPECT_FALSE(Affine::scale({1, 0, 1}).inverse());
  EXPECT_FALSE(Affine::scale({1, std::numeric_limits<double>::quiet_NaN(), 1}).inverse());
  EXPECT_FALSE(Affine::scale({1, std::numeric_limits<double>::infinity(), 1}).inverse());
  EXPECT_TRUE(Affine::scale({1e-6, 1e-6, 1e-6}).inverse()) << "small is not singular";
}

TEST(Affine, SimilarityIsTheFactorOfMapsThatKeepAngles) {
  const Affine turn = Affine::rotate({1, 2, 3}, 0.7);
  EXPECT_NEAR((turn * Affine::scale({3, 3, 3})).similarity().value(), 3, 1e-12);
  EXPECT_NEAR((turn * Affine::scale({-2, 2, 2})).similarity().value(), 2, 1e-12);
  EXPECT_FALSE((turn * Affine::scale({1, 1, 1.001})).similarity());
  EXPECT_FALSE(Affine::scale({0, 0, 0}).similarity());
}

}  // namespace
}  // namespace isolux
