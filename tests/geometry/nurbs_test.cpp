#include "isolux/geometry/nurbs.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/turned_nurbs.h"
#include "geometry/zoo.h"
#include "isolux/core/error.h"
#include "isolux/geometry/bezier.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/frustum.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"

namespace isolux {
namespace {

using std::numbers::pi;

struct Surface {
  KnotVector u, v;
  Nurbs::Points points;
  Nurbs::Weights weights;

  Nurbs shape() const { return Nurbs(u, v, points, weights); }
};

double uniform(Random& random, double from, double to) {
  return from + (to - from) * random.uniform();
}

/// Knots of any kind: with both ends at the curve's or not, some of them several times.
KnotVector random_knots(Random& random, std::size_t degree, std::size_t points) {
  const std::size_t count = points + degree + 1, at_ends = random.below(2) * (degree + 1);
  KnotVector vector{degree, {}};
  auto& knots = vector.knots;
  do {
    knots.assign(at_ends, 0);
    double knot = 0;
    while (knots.size() + at_ends < count) {
      knot += uniform(random, 0.1, 1);
      const std::size_t room = count - at_ends - knots.size();
      knots.insert(knots.end(), std::min(room, 1 + random.below(degree)), knot);
    }
    knots.insert(knots.end(), at_ends, knot + 1);
  } while (!(knots[degree] < knots[points]));
  return vector;
}

/// A hilly grid over the plane z = 0, about as many metres wide as it has points.
Surface random_surface(Random& random, double wildness, double contrast) {
  const auto degree = [&] { return 1 + random.below(3); };
  const std::size_t du = degree(), dv = degree();
  const std::size_t columns = du + 1 + random.below(4), rows = dv + 1 + random.below(4);
  Surface s{random_knots(random, du, columns), random_knots(random, dv, rows), {}, {}};
  for (std::size_t j = 0; j < rows; ++j) {
    auto& row = s.points.emplace_back();
    auto& weights = s.weights.emplace_back();
    for (std::size_t i = 0; i < columns; ++i) {
      const auto shift = [&] { return wildness * (random.uniform() - 0.5); };
      row.push_back({double(i) + shift(), double(j) + shift(), shift()});
      weights.push_back(std::pow(contrast, random.uniform()));
    }
  }
  return s;
}

/// The basis function of point i, by the recursion of Cox and de Boor.
double basis(const KnotVector& vector, std::size_t i, std::size_t degree, double at) {
  const auto& t = vector.knots;
  if (degree == 0) return at >= t[i] && at < t[i + 1] ? 1 : 0;
  const auto part = [&](double above, double below, double f) {
    return below > 0 ? above / below * f : 0;
  };
  return part(at - t[i], t[i + degree] - t[i], basis(vector, i, degree - 1, at)) +
         part(t[i + degree + 1] - at, t[i + degree + 1] - t[i + 1],
              basis(vector, i + 1, degree - 1, at));
}

Vec3 point_of(const Surface& s, double u, double v) {
  Vec3 sum;
  double total = 0;
  for (std::size_t j = 0; j < s.points.size(); ++j) {
    for (std::size_t i = 0; i < s.points[j].size(); ++i) {
      const double weight =
          s.weights[j][i] * basis(s.u, i, s.u.degree, u) * basis(s.v, j, s.v.degree, v);
      sum += s.points[j][i] * weight, total += weight;
    }
  }
  return sum / total;
}

/// A parameter that the curve runs over.
double random_parameter(Random& random, const KnotVector& vector) {
  const auto& t = vector.knots;
  return uniform(random, t[vector.degree], t[t.size() - vector.degree - 1]);
}

/// That lines meet both at the same points, to 1e-10 m where they don't graze; how many.
std::size_t expect_same_hits(const Shape& a, const Shape& b) {
  Random random(1);
  const Bounds box = b.bounds();
  std::size_t count = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = random_line(random, box.center(), 0.5 * box.diagonal(), 5);
    const Hits there = hits_of(a, ray), here = hits_of(b, ray);
    EXPECT_EQ(there.size(), here.size()) << i;
    if (there.size() != here.size()) continue;
    for (std::size_t k = 0; k < here.size(); ++k) {
      const double sine = std::abs(dot(here[k].normal, ray.direction));
      EXPECT_LT(distance(there[k].point, here[k].point) * sine, 1e-11);
      EXPECT_LT(distance(there[k].normal, here[k].normal) * sine, 1e-9);
    }
    count += here.size();
  }
  return count;
}

TEST(NurbsTest, TurnedCurvesAreTheClosedShapes) {
  const Vec3 z{0, 0, 1};
  const struct {
    RationalCurve curve;
    ShapePtr same;
  } cases[] = {
      {arc(0, 1.5, -2, 2), std::make_shared<Sphere>(Vec3{}, 1.5)},
      {arc(2, 0.5, -4, 4), std::make_shared<Torus>(Vec3{}, z, 2, 0.5)},
      {line({1, 0, -1}, {1, 0, 2}), std::make_shared<Cylinder>(-z, z * 2, 1, false)},
      {line({2, 0, -1}, {0.5, 0, 1}), std::make_shared<Frustum>(-z, z, 2, 0.5, false)},
      {line({1, 0, 0}, {0, 0, 1}), std::make_shared<Frustum>(Vec3{}, z, 1, 0, false)},
  };
  for (const auto& [curve, same] : cases) {
    const auto shape = turned(curve);
    EXPECT_FALSE(shape->solid());
    EXPECT_NEAR(*shape->area(), *same->area(), 1e-9 * *same->area());
    EXPECT_GT(expect_same_hits(*shape, *same), 500u);
  }
}

TEST(NurbsTest, OneStretchOfKnotsIsABezierPatch) {
  Random random(2);
  for (int round = 0; round < 20; ++round) {
    Bezier::Points patch;
    Nurbs::Points rows(4);
    for (std::size_t k = 0; k < 16; ++k) {
      patch.push_back({double(k % 4) + random.uniform(), double(k / 4), random.uniform()});
      rows[k / 4].push_back(patch.back());
    }
    const KnotVector knots{3, {-2, -2, -2, -2, 5, 5, 5, 5}};
    const Nurbs shape(knots, knots, rows);
    const Bezier same({patch});
    EXPECT_EQ(*shape.area(), *same.area());
    EXPECT_EQ(shape.part_count(), same.part_count());
    for (int i = 0; i < 100; ++i) {
      const Ray ray = random_line(random, same.bounds().center(), 1.5, 5);
      const Hits a = hits_of(shape, ray), b = hits_of(same, ray);
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].point, b[k].point);
    }
  }
}

// Whatever its degrees, knots and weights, a line through any point of the surface meets it there.
TEST(NurbsTest, EveryPointOfTheDefinitionIsMet) {
  Random random(3);
  for (int round = 0; round < 300; ++round) {
    const double contrast = std::array{1.0, 10.0, 1e3}[round % 3];
    const Surface s = random_surface(random, round % 2 == 0 ? 0.5 : 2, contrast);
    const Nurbs shape = s.shape();
    for (int k = 0; k < 30; ++k) {
      const Vec3 p = point_of(s, random_parameter(random, s.u), random_parameter(random, s.v));
      const Vec3 d = random_direction(random);
      double nearest = 1, grazing = 1;
      for (const Hit& hit : hits_of(shape, {p - d * 3, d})) {
        grazing = std::min(grazing, std::abs(dot(hit.normal, d)));
        nearest = std::min(nearest, distance(hit.point, p));
      }
      if (grazing < 1e-5) continue;
      EXPECT_LT(nearest, 1e-11 / grazing) << "round " << round;
    }
  }
}

/// One more knot, and the points of the same curve with it (Boehm's rule).
template <typename Point>
std::vector<Point> inserted(KnotVector& vector, const std::vector<Point>& points, double at) {
  const auto& [degree, t] = vector;
  std::vector<Point> all;
  for (std::size_t i = 0; i <= points.size(); ++i) {
    const double share = std::clamp((at - t[i]) / (t[i + degree] - t[i]), 0.0, 1.0);
    if (!(share < 1)) {
      all.push_back(points[i]);
    } else if (!(share > 0)) {
      all.push_back(points[i - 1]);
    } else {
      all.push_back(points[i - 1] * (1 - share) + points[i] * share);
    }
  }
  vector.knots.insert(std::upper_bound(t.begin(), t.end(), at), at);
  return all;
}

TEST(NurbsTest, AKnotMoreLeavesTheSurface) {
  Random random(4);
  for (int round = 0; round < 30; ++round) {
    Surface s = random_surface(random, 0.5, 1);
    s.weights.clear();
    const Nurbs before = s.shape();
    const double u = random_parameter(random, s.u), v = random_parameter(random, s.v);
    const KnotVector knots = s.u;
    for (auto& row : s.points) {
      s.u = knots;
      row = inserted(s.u, row, u);
    }
    Nurbs::Points columns;
    for (std::size_t i = 0; i < s.points[0].size(); ++i) {
      KnotVector vector = s.v;
      std::vector<Vec3> column;
      for (const auto& row : s.points) column.push_back(row[i]);
      columns.push_back(inserted(vector, column, v));
      if (i + 1 == s.points[0].size()) s.v = vector;
    }
    s.points.assign(columns[0].size(), {});
    for (const auto& column : columns) {
      for (std::size_t j = 0; j < column.size(); ++j) s.points[j].push_back(column[j]);
    }
    const Nurbs after = s.shape();
    EXPECT_NEAR(*after.area(), *before.area(), 1e-8 * *before.area());
    EXPECT_GT(expect_same_hits(after, before), 100u);
  }
}

// Weights move points within the plane, not off it.
TEST(NurbsTest, AWeightedPlaneStaysAPlane) {
  Random random(5);
  for (const double contrast : {10.0, 1e3, 1e6}) {
    const Vec3 corner{1, 2, 3}, u{1, 0.5, 0}, v{-0.2, 1, 0.7};
    Surface s{{3, {0, 0, 0, 0, 1, 1, 1, 1}}, {2, {0, 0, 0, 1, 2, 2, 2}}, {}, {}};
    for (int j = 0; j < 4; ++j) {
      auto& row = s.points.emplace_back();
      auto& weights = s.weights.emplace_back();
      for (int i = 0; i < 4; ++i) {
        row.push_back(corner + u * (i / 3.0) + v * (j / 3.0));
        weights.push_back(std::pow(contrast, random.uniform()));
      }
    }
    EXPECT_GT(expect_same_hits(s.shape(), Parallelogram(corner, u, v)), 300u) << contrast;
  }
}

// Lines through the knots, where the patches meet, and through the seam of what closes.
TEST(NurbsTest, NoLineSlipsThroughASeam) {
  Random random(6);
  const auto ring = turned(arc(2, 0.7, -4, 4));
  for (int k = 0; k < 2000; ++k) {
    const double a = k % 2 == 0 ? pi / 2 * double(random.below(4)) : 2 * pi * random.uniform();
    const double b = k % 2 == 1 ? pi / 2 * double(random.below(4)) : 2 * pi * random.uniform();
    const double r = 2 + 0.7 * std::cos(b);
    const Vec3 p{r * std::cos(a), r * std::sin(a), 0.7 * std::sin(b)};
    const Vec3 d = random_direction(random);
    EXPECT_FALSE(hits_of(*ring, {p - d * 7, d}).empty());
  }
}

// A point that is there degree + 1 times: between its knots there is nothing.
TEST(NurbsTest, PatchesThatAreNoneAreLeftOut) {
  const KnotVector u{1, {0, 0, 1, 2, 3, 3}}, v{1, {0, 0, 1, 1}};
  const Nurbs::Points rows = {{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {3, 0, 0}},
                              {{0, 2, 0}, {1, 2, 0}, {1, 2, 0}, {3, 2, 0}}};
  const Nurbs shape(u, v, rows);
  EXPECT_NEAR(*shape.area(), 6, 1e-12);
  EXPECT_GT(expect_same_hits(shape, Parallelogram({}, {3, 0, 0}, {0, 2, 0})), 300u);
}

std::string refusal(const Surface& s) {
  try {
    s.shape();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(NurbsTest, WhatIsNoSurfaceIsRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Surface good;
  good.u = {2, {0, 0, 0, 1, 1, 1}};
  good.v = {1, {0, 0, 1, 1}};
  good.points = {{{0, 0, 0}, {1, 0, 1}, {2, 0, 0}}, {{0, 1, 0}, {1, 1, 1}, {2, 1, 0}}};
  good.weights = {{1, 2, 1}, {1, 2, 1}};
  EXPECT_EQ(refusal(good), "none");
  const auto changed = [&](auto change) {
    Surface s = good;
    change(s);
    return refusal(s);
  };
  const auto with_knots = [&](std::vector<double> knots) {
    return changed([&](Surface& s) { s.u.knots = std::move(knots); });
  };
  EXPECT_EQ(with_knots({0, 0, 0, 1, 1}), "u_knots: 3 points of degree 2 take 6 knots, not 5");
  EXPECT_EQ(with_knots({0, 0, 1, 0, 1, 1}), "u_knots: must not fall, as 0 does after 1");
  EXPECT_EQ(with_knots({0, 0, 0, nan, 1, 1}),
            "u_knots: must be finite numbers between -1e+12 and 1e+12, not nan");
  EXPECT_EQ(with_knots({0, 0, 0, 1, 1, 1e300}),
            "u_knots: must be finite numbers between -1e+12 and 1e+12, not 1e+300");
  EXPECT_EQ(with_knots({0, 0, 1, 1, 2, 2}),
            "u_knots: the curve runs from knot 3 to knot 4, which are both 1");
  EXPECT_EQ(with_knots({0, 1, 1, 2, 2, 2}), "none");
  const auto longer = [&](std::vector<double> knots) {
    return changed([&](Surface& s) {
      s.u.knots = std::move(knots);
      s.weights.clear();
      for (auto& row : s.points) {
        row.push_back({4, row[0].y, 0});
        row.push_back({5, row[0].y, 0});
        row.push_back({6, row[0].y, 0});
      }
    });
  };
  EXPECT_EQ(longer({0, 0, 0, 1, 1, 2, 3, 3, 3}), "none");
  EXPECT_EQ(longer({0, 0, 0, 1, 1, 1, 3, 3, 3}),
            "u_knots: 1 is there 3 times, where a degree of 2 allows 2");
  EXPECT_EQ(longer({0, 0, 0, 0, 1, 2, 3, 3, 3}),
            "u_knots: 0 is there 4 times, where a degree of 2 allows 3");
  EXPECT_EQ(changed([](Surface& s) { s.v.degree = 4; }),
            "v_knots: the degree must be 1 to 3, not 4");
  EXPECT_EQ(changed([](Surface& s) { s.u.degree = 0; }),
            "u_knots: the degree must be 1 to 3, not 0");
  EXPECT_EQ(changed([](Surface& s) { s.v.degree = 3; }),
            "v_knots: a degree of 3 takes 4 points at least, not 2");
  EXPECT_EQ(changed([](Surface& s) { s.points.clear(); }),
            "u_knots: a degree of 2 takes 3 points at least, not 0");
  EXPECT_EQ(changed([](Surface& s) { s.points[1].pop_back(); }),
            "points: row number 2 has 2, not 3");
  EXPECT_EQ(changed([](Surface& s) { s.points[1][1].z = 1e300; }).substr(0, 7), "points:");
  EXPECT_EQ(changed([](Surface& s) { s.points[1] = s.points[0]; }),
            "points: the surface has no area");
  EXPECT_EQ(changed([](Surface& s) { s.weights.pop_back(); }), "weights: must be 2 rows, not 1");
  EXPECT_EQ(changed([](Surface& s) { s.weights[0].pop_back(); }),
            "weights: row number 1 has 2, not 3");
  for (const double bad : {0.0, -1.0}) {
    EXPECT_EQ(changed([&](Surface& s) { s.weights[1][2] = bad; }),
              "weights: must be more than 0, not " + std::string(bad == 0 ? "0" : "-1"));
  }
  EXPECT_EQ(changed([&](Surface& s) { s.weights[1][2] = nan; }),
            "weights: must be more than 0, not nan");
  EXPECT_EQ(changed([](Surface& s) { s.weights[1][2] = 2e6; }),
            "weights: the largest may be 1e+06 times the least, not 2e+06");
}

TEST(NurbsTest, TooManyPatchesAreRefused) {
  const std::size_t size = 300;
  Surface s;
  s.u.degree = s.v.degree = 1;
  for (std::size_t j = 0; j < size; ++j) {
    auto& row = s.points.emplace_back();
    for (std::size_t i = 0; i < size; ++i) row.push_back({double(i), double(j), 0});
  }
  for (std::size_t i = 0; i < size + 2; ++i) s.u.knots.push_back(double(i));
  s.v.knots = s.u.knots;
  EXPECT_EQ(refusal(s), "points: make 299 by 299 patches, more than 65536");
}

}  // namespace
}  // namespace isolux
