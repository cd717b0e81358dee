#include "isolux/geometry/implicit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "geometry/zoo.h"
#include "isolux/core/error.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"

namespace isolux {
namespace {

using std::numbers::pi;

std::shared_ptr<Implicit> implicit(const char* function, double half) {
  const Vec3 corner = Vec3{1, 1, 1} * half;
  return std::make_shared<Implicit>(Expression(function), Vec3{} - corner, corner);
}

void expect_same_hits(const Shape& a, const Shape& b, double radius) {
  Random random(1);
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = random_line(random, {}, radius, 5);
    const Hits x = hits_of(a, ray), y = hits_of(b, ray);
    double sharpness = 1;
    for (const Hit& hit : y)
      sharpness = std::min(sharpness, std::abs(dot(hit.normal, ray.direction)));
    if (sharpness < 1e-5) continue;
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t k = 0; k < x.size(); ++k) {
      EXPECT_LT(distance(x[k].point, y[k].point), 1e-13 / sharpness);
      EXPECT_LT(distance(x[k].normal, y[k].normal), 1e-12 / sharpness);
    }
  }
}

TEST(ImplicitTest, ASphereAndATorusAreThose) {
  expect_same_hits(*implicit("x^2 + y^2 + z^2 - 1", 1.2), Sphere({}, 1), 1.1);
  expect_same_hits(*implicit("(sqrt(x^2 + y^2) - 1)^2 + z^2 - 0.16", 1.5),
                   Torus({}, {0, 0, 1}, 1, 0.4), 1.5);
}

TEST(ImplicitTest, TheBoxCutsOff) {
  const auto half = implicit("x + 2*y", 1);
  const Hits hits = hits_of(*half, {{-5, 0, 0.5}, {1, 0, 0}});
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].normal, (Vec3{-1, 0, 0}));
  EXPECT_EQ(hits[0].face, 0u);
  EXPECT_EQ(hits[1].face, 6u);
  EXPECT_NEAR(hits[1].point.x, 0, 1e-15);
  EXPECT_LT(distance(hits[1].normal, normalized(Vec3{1, 2, 0})), 1e-14);
  EXPECT_TRUE(half->contains({-0.5, 0, 0}));
  EXPECT_FALSE(half->contains({-1.5, 0, 0}));
  EXPECT_TRUE(half->avoids({{0.5, 0.5, 0.5}, {3, 3, 3}}));
  EXPECT_TRUE(half->avoids({{-1, -1, -1}, {-0.5, -0.5, 0}}));
  EXPECT_FALSE(half->avoids({{-0.1, -0.1, 0}, {0.1, 0.1, 0.1}}));
  EXPECT_FALSE(half->avoids({{-1.1, -1, -1}, {-0.5, -0.5, 0}}));
}

// Against small steps along the line: no crossing is missed, and each hit lies between two steps.
TEST(ImplicitTest, EveryCrossingIsFound) {
  constexpr int kSteps = 4000;
  const char* const functions[] = {"sin(5*x)*cos(5*y) + sin(5*y)*cos(5*z) + sin(5*z)*cos(5*x)",
                                   "x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + 11.8",
                                   "abs(sin(4*x + y) - z/2) - 0.05",
                                   "max(min(x^2 + y^2, z^2 + (y - 0.3)^2) - 0.1, abs(x*y*z) - 0.2)",
                                   "1/x + y + 3*z",
                                   "sqrt(x - 0.3) + sqrt(y) - 0.9*exp(-z^2)"};
  Random random(5);
  std::size_t crossings = 0;
  for (const char* const text : functions) {
    const auto shape = implicit(text, 2);
    for (int i = 0; i < 300; ++i) {
      const Ray ray = random_line(random, {}, 2.5, 5);
      const Hits hits = hits_of(*shape, ray);
      ASSERT_EQ(hits.size() % 2, 0u);
      std::size_t passed = 0;
      for (int k = 1; k <= kSteps; ++k) {
        const double t = 10.0 * k / kSteps;
        while (passed < hits.size() && hits[passed].t < t) ++passed, ++crossings;
        const bool near = (passed > 0 && t - hits[passed - 1].t < 1e-9) ||
                          (passed < hits.size() && hits[passed].t - t < 1e-9);
        if (near) continue;
        ASSERT_EQ(passed % 2 == 1, shape->contains(ray.at(t))) << text << " at " << t;
      }
    }
  }
  EXPECT_GT(crossings, 4000u);
}

TEST(ImplicitTest, SheetsAThousandthOfAMillimetreThick) {
  const auto sheet = implicit("(x - 0.3*y)^2 - 1e-12", 1);
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 through{0, 0, 1.8 * random.uniform() - 0.9};
    const Hits hits = hits_of(*sheet, {through, random_direction(random)});
    EXPECT_EQ(hits.size(), 2u);
  }
  // What touches in a point is no solid, but does no harm.
  EXPECT_EQ(hits_of(*implicit("(x - 0.3)^2", 1), {{-5, 0, 0}, {1, 0, 0}}).size(), 0u);
}

TEST(ImplicitTest, VolumeInCsg) {
  // Half of a ball.
  const auto ball = implicit("x^2 + y^2 + z^2 - 1", 1.5);
  const auto half = implicit("x", 2);
  const Csg cut(CsgOperation::intersect, ball, half);
  Random random(9);
  double chords = 0;
  constexpr int kCount = 100'000;
  for (int i = 0; i < kCount; ++i) {
    const Hits hits = hits_of(cut, random_line(random, {}, 1.2, 1.2));
    for (std::size_t k = 0; k + 1 < hits.size(); k += 2) chords += hits[k + 1].t - hits[k].t;
  }
  EXPECT_NEAR(chords / kCount * pi * 1.44, 2 * pi / 3, 0.02);
}

// Functions that can't be decided end by the limit of pieces.
TEST(ImplicitTest, HostileFunctionsTakeBoundedTime) {
  std::string waves = "0";
  for (int i = 1; i <= 40; ++i) waves += " + sin(" + std::to_string(i * 1000) + "*x*y*z)";
  const std::string functions[] = {waves,
                                   "sin(1e9*x)",
                                   "x - x - 1e-30",
                                   "exp(exp(exp(x*100))) - exp(exp(exp(y*100)))",
                                   "0/0*x",
                                   "x*0 + y*0 - exp(-1000)",
                                   "(x-y)^64 * 1e-300 - 1e-300",
                                   "1/(x-x)",
                                   "1/sin(1e6*x)"};
  Random random(4);
  for (const std::string& text : functions) {
    const auto shape = implicit(text.c_str(), 1);
    for (int i = 0; i < 20; ++i) {
      const Hits hits = hits_of(*shape, random_line(random, {}, 1, 3));
      EXPECT_EQ(hits.size() % 2, 0u) << text;
      for (const Hit& hit : hits) EXPECT_NEAR(length(hit.normal), 1, 1e-12) << text;
    }
  }
}

TEST(ImplicitTest, NothingInsideIsRefused) {
  try {
    implicit("x^2 + 1", 1);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "function: must be negative somewhere in the box, but is nowhere");
  }
  EXPECT_THROW(Implicit(Expression("x"), {0, 0, 0}, {1, 0, 1}), InputError);
}

}  // namespace
}  // namespace isolux
