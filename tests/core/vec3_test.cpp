#include "isolux/core/vec3.h"

#include <gtest/gtest.h>

#include "isolux/core/random.h"

namespace isolux {
namespace {

TEST(Vec3, CrossIsPerpendicularAndRightHanded) {
  EXPECT_EQ(cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
  const Vec3 a{1, 2, 3}, b{-2, 0.5, 4};
  EXPECT_NEAR(dot(cross(a, b), a), 0, 1e-14);
  EXPECT_NEAR(dot(cross(a, b), b), 0, 1e-14);
}

TEST(Vec3, ZeroStaysZeroWhenNormalized) { EXPECT_EQ(normalized(Vec3{}), Vec3{}); }

TEST(Frame, IsOrthonormalAndRightHandedForEveryNormal) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 n = normalized(
        {random.uniform() - 0.5, random.uniform() - 0.5, (random.uniform() - 0.5) * (i % 3)});
    const Frame frame(n);
    EXPECT_NEAR(length(frame.u), 1, 1e-14);
    EXPECT_NEAR(dot(frame.u, n), 0, 1e-14);
    EXPECT_LT(distance(cross(frame.u, frame.v), n), 1e-14);
  }
}

TEST(Bounds, GrowFromNothing) {
  Bounds box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.diagonal(), 0);
  box.include(Bounds{});
  EXPECT_TRUE(box.empty());
  box.include(Vec3{1, 2, 3});
  EXPECT_FALSE(box.empty());
  box.include(Vec3{1, 2, 5});
  EXPECT_EQ(box.diagonal(), 2);
  EXPECT_EQ(box.center(), (Vec3{1, 2, 4}));
}

TEST(Vec3, AUnitVectorStaysAsItIs) {
  for (const Vec3& a : {Vec3{1, 2, 3}, Vec3{-0.1, 0.7, 1e-9}, Vec3{5, 1e3, -2}, Vec3{3, 4, 0}}) {
    const Vec3 unit = normalized(a);
    EXPECT_TRUE(is_unit(unit));
    EXPECT_EQ(unit_vector(unit), unit);
    EXPECT_FALSE(is_unit(a));
    EXPECT_EQ(unit_vector(a), unit);
  }
}

}  // namespace
}  // namespace isolux
