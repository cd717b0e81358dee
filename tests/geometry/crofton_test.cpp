// Integral geometry as a second road to areas and volumes (Santaló 2004, I.2): of the random lines
// that meet a convex body of surface A_K, the mean number of hits with a surface is 2 A / A_K, and
// the mean length inside a solid is 4 V / A_K.
#include <gtest/gtest.h>

#include <numbers>

#include "geometry/zoo.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/sphere.h"
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

void expect_measures(const Shape& shape, double area, std::optional<double> volume) {
  Random random(42);
  const Bounds box = shape.bounds();
  const double radius = 0.5 * box.diagonal(), sphere_area = 4 * pi * radius * radius;
  Estimate hit_count, inside;
  for (int i = 0; i < 100'000; ++i) {
    const Hits hits = hits_of(shape, random_line(random, box.center(), radius, radius));
    hit_count.add(static_cast<double>(hits.size()));
    double sum = 0;
    for (std::size_t k = 0; k + 1 < hits.size(); k += 2) sum += hits[k + 1].t - hits[k].t;
    inside.add(sum);
  }
  // Four standard errors: wrong once in 16 000 seeds, and this is one seed.
  EXPECT_NEAR(hit_count.mean(), 2 * area / sphere_area, 4 * hit_count.error());
  if (volume) {
    EXPECT_NEAR(inside.mean(), 4 * *volume / sphere_area, 4 * inside.error());
  }
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

}  // namespace
}  // namespace isolux
