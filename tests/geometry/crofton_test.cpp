// Integral geometry as a second road to areas and volumes (Santaló 2004, I.2): of the random lines
// that meet a convex body of surface A_K, the mean number of hits with a surface is 2 A / A_K, and
// the mean length inside a solid is 4 V / A_K.
#include <gtest/gtest.h>

#include <numbers>

#include "geometry/zoo.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/prism.h"
#include "isolux/geometry/revolution.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/swept_sphere.h"
#include "isolux/geometry/torus.h"

namespace isolux {
namespace {

using std::numbers::pi;

/// A mean with its standard error.
struct Estimate {
  double sum = 0, sum_of_squares = 0, count = 0;

  void add(double x) { sum += x, sum_of_squares += x * x, ++count; }
  double mean() const { return sum / count; }
  double error() const { return std::sqrt((sum_of_squares / count - mean() * mean()) / count); }
};

double length_inside(const Hits& hits) {
  double sum = 0;
  for (std::size_t k = 0; k + 1 < hits.size(); k += 2) sum += hits[k + 1].t - hits[k].t;
  return sum;
}

void expect_measures(const Shape& shape, double area, std::optional<double> volume) {
  Random random(42);
  const Bounds box = shape.bounds();
  const double radius = 0.5 * box.diagonal(), sphere_area = 4 * pi * radius * radius;
  Estimate hit_count, inside;
  for (int i = 0; i < 100'000; ++i) {
    const Hits hits = hits_of(shape, random_line(random, box.center(), radius, radius));
    hit_count.add(static_cast<double>(hits.size()));
    inside.add(length_inside(hits));
  }
  // Four standard errors: wrong once in 16 000 seeds, and this is one seed.
  EXPECT_NEAR(hit_count.mean(), 2 * area / sphere_area, 4 * hit_count.error());
  if (volume) {
    EXPECT_NEAR(inside.mean(), 4 * *volume / sphere_area, 4 * inside.error());
  }
}

void expect_volume(const Shape& shape, double volume) {
  Random random(42);
  const Bounds box = shape.bounds();
  const double radius = 0.5 * box.diagonal(), sphere_area = 4 * pi * radius * radius;
  Estimate inside;
  for (int i = 0; i < 100'000; ++i) {
    inside.add(length_inside(hits_of(shape, random_line(random, box.center(), radius, radius))));
  }
  EXPECT_NEAR(inside.mean(), 4 * volume / sphere_area, 4 * inside.error());
}

TEST(CroftonTest, ShapesWithAFormulaForTheirArea) {
  for (const Specimen& s : zoo()) {
    if (!s.shape->area()) continue;
    SCOPED_TRACE(s.name);
    expect_measures(*s.shape, *s.shape->area(), std::nullopt);
  }
}

TEST(CroftonTest, Torus) {
  const double R = 1, r = 0.4;
  const Torus torus({}, {1, 1, 1}, R, r);
  EXPECT_DOUBLE_EQ(*torus.area(), 4 * pi * pi * R * r);
  expect_measures(torus, *torus.area(), 2 * pi * pi * R * r * r);
}

TEST(CroftonTest, LensAndItsRelatives) {
  // Two unit spheres at distance 1: caps of height 1/2.
  const auto a = std::make_shared<Sphere>(Vec3{}, 1),
             b = std::make_shared<Sphere>(Vec3{1, 0, 0}, 1);
  const double h = 0.5, cap_area = 2 * pi * h, cap_volume = pi * h * h * (3 - h) / 3;
  const double ball_area = 4 * pi, ball_volume = 4 * pi / 3;
  expect_measures(Csg(CsgOperation::intersect, a, b), 2 * cap_area, 2 * cap_volume);
  expect_measures(Csg(CsgOperation::unite, a, b), 2 * (ball_area - cap_area),
                  2 * (ball_volume - cap_volume));
  expect_measures(Csg(CsgOperation::subtract, a, b), ball_area, ball_volume - 2 * cap_volume);
}

TEST(CroftonTest, DrilledCube) {
  const double r = 0.3;
  const auto cube = std::make_shared<Box>(Vec3{0, 0, 0}, Vec3{1, 1, 1});
  const auto drill = std::make_shared<Cylinder>(Vec3{0.5, 0.5, -1}, Vec3{0.5, 0.5, 2}, r, true);
  expect_measures(Csg(CsgOperation::subtract, cube, drill), 6 - 2 * pi * r * r + 2 * pi * r,
                  1 - pi * r * r);
}

TEST(CroftonTest, PrismsKeepTheirVolumeWhenTheyTurn) {
  // An L of area 4 with a triangular hole of 1/2. Scaled by k at the top, (1 + k + k²) / 3 of it.
  const std::vector<Vec3> l = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  const std::vector<std::vector<Vec3>> hole = {{{0.1, 0.5, 0}, {0.9, 0.5, 0}, {0.5, 1.75, 0}}};
  const double area = 4 - 0.5, height = 2;
  for (const double twist : {0.0, 90.0, -500.0}) {
    const Prism prism(l, hole, {0.3, 0, height}, PrismTop{{1, 1, 0}, {0.5, 0.5}, twist});
    ASSERT_EQ(prism.area().has_value(), twist == 0);
    expect_volume(prism, area * height * (1 + 0.5 + 0.25) / 3);
  }
  const Prism ridge(l, hole, {0, 0, height}, PrismTop{{1, 1, 0}, {1, 0}});
  expect_volume(ridge, area * height / 2);
}

TEST(CroftonTest, RevolutionsFollowPappus) {
  // A triangle of area 1/2, its centroid at r = 4/3.
  const std::vector<ProfilePoint> triangle = {{1, 0}, {2, 0}, {1, 1}};
  const double whole = 2 * pi * (4.0 / 3) * 0.5;
  const double sides = 2 * pi * (1.5 + 1.5 * std::sqrt(2.0) + 1);
  expect_measures(Revolution({}, {1, 1, 1}, triangle), sides, whole);
  expect_measures(Revolution({}, {1, 1, 1}, triangle, {.angle = 90}), sides / 4 + 1, whole / 4);
}

TEST(CroftonTest, ACurveThroughPointsOfACircleIsNearlyASphere) {
  std::vector<ProfilePoint> half;
  for (int i = 0; i <= 16; ++i) {
    const double angle = pi * (i / 16.0 - 0.5);
    half.push_back({i % 16 == 0 ? 0 : std::cos(angle), std::sin(angle)});
  }
  const Revolution ball({}, {0, 0, 1}, half, {.smooth = true});
  EXPECT_NEAR(*ball.area(), 4 * pi, 1e-3);
  expect_measures(ball, *ball.area(), 4 * pi / 3);
}

TEST(CroftonTest, SweptSpheres) {
  // A straight one is a capsule.
  const double r = 0.3, l = 2;
  const SweptSphere capsule({{{0, 0, 0}, r}, {{l, 0, 0}, r}}, false);
  expect_measures(capsule, 2 * pi * r * l + 4 * pi * r * r,
                  pi * r * r * l + 4 * pi * r * r * r / 3);
  // Around a circle it is nearly a torus.
  std::vector<CurvePoint> circle;
  for (int i = 0; i < 24; ++i) {
    circle.push_back({{std::cos(i * pi / 12), std::sin(i * pi / 12), 0}, r});
  }
  expect_measures(SweptSphere(circle, true), 4 * pi * pi * r, 2 * pi * pi * r * r);
  // A straight one whose radius changes evenly is a cone with balls for ends: they bulge less than
  // the smaller ball at one end, and touch it along circles off the ends by the slope.
  const double big = 0.5, small = 0.1, slope = (big - small) / l;
  const double flank = std::sqrt(1 - slope * slope);
  const double side = pi * (big + small) * flank * flank * l;
  const double ends = 2 * pi * big * big * (1 + slope) + 2 * pi * small * small * (1 - slope);
  const SweptSphere cone({{{0, 0, 0}, big}, {{l, 0, 0}, small}}, false);
  expect_measures(cone, side + ends, std::nullopt);
}

}  // namespace
}  // namespace isolux
