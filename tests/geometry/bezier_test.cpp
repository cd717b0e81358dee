#include "isolux/geometry/bezier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "geometry/zoo.h"
#include "isolux/core/error.h"
#include "isolux/geometry/bernstein.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux {
namespace {

using std::numbers::pi;
using Points = Bezier::Points;

/// The patch whose control points are point(i, j), i along u.
template <typename F>
Points patch(const F& point) {
  Points points;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) points.push_back(point(i, j));
  }
  return points;
}

Points random_patch(Random& random, double wildness) {
  return patch([&](int i, int j) {
    const auto shift = [&] { return wildness * (random.uniform() - 0.5); };
    return Vec3{i + shift(), j + shift(), shift()};
  });
}

Vec3 point_of(const Points& points, double u, double v) {
  const auto weights = [](double t) {
    const double s = 1 - t;
    return std::array{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  const auto wu = weights(u), wv = weights(v);
  Vec3 p;
  for (std::size_t k = 0; k < 16; ++k) p += points[k] * (wu[k % 4] * wv[k / 4]);
  return p;
}

TEST(BezierTest, AFlatPatchIsAParallelogram) {
  const Vec3 corner{1, 2, 3}, u{1, 0.5, 0}, v{-0.2, 1, 0.7};
  const Bezier flat({patch([&](int i, int j) { return corner + u * (i / 3.0) + v * (j / 3.0); })});
  const Parallelogram same(corner, u, v);
  EXPECT_NEAR(*flat.area(), *same.area(), 1e-12);
  Random random(1);
  std::size_t met = 0;
  for (int i = 0; i < 5000; ++i) {
    const Ray ray = random_line(random, corner + (u + v) * 0.5, 1, 5);
    const Hits a = hits_of(flat, ray), b = hits_of(same, ray);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
      EXPECT_LT(distance(a[k].point, b[k].point), 1e-12);
      EXPECT_LT(distance(a[k].normal, b[k].normal), 1e-12);
    }
    met += a.size();
  }
  EXPECT_GT(met, 500u);
  // Edge-on, from within and along an edge.
  EXPECT_TRUE(hits_of(flat, {corner - u, u + v * 0.5}).empty());
  EXPECT_TRUE(hits_of(flat, {corner - u, u}).empty());
}

// A line through any point of the surface meets it there.
TEST(BezierTest, EveryPointOfThePatchIsMet) {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    const Points points = random_patch(random, round % 2 == 0 ? 1.5 : 6);
    const Bezier shape({points});
    for (int k = 0; k < 50; ++k) {
      const Vec3 p = point_of(points, random.uniform(), random.uniform());
      const Vec3 d = random_direction(random);
      const Hits hits = hits_of(shape, {p - d * 3, d});
      double nearest = 1, grazing = 1;
      for (const Hit& hit : hits) {
        grazing = std::min(grazing, std::abs(dot(hit.normal, d)));
        nearest = std::min(nearest, distance(hit.point, p));
      }
      if (!hits.empty() && grazing < 1e-5) continue;
      EXPECT_LT(nearest, 1e-12 / grazing) << "round " << round;
    }
  }
}

// Against 200 × 200 cells of triangles: as many hits but beside folds and edges.
TEST(BezierTest, HitsOfATessellation) {
  constexpr std::uint32_t kCells = 200;
  Random random(3);
  std::size_t several = 0, lines = 0, differing = 0;
  for (int round = 0; round < 4; ++round) {
    const Points points = random_patch(random, 6);
    const Bezier shape({points});
    TriangleSoup soup;
    for (std::uint32_t j = 0; j <= kCells; ++j) {
      for (std::uint32_t i = 0; i <= kCells; ++i) {
        soup.points.push_back(point_of(points, i / double{kCells}, j / double{kCells}));
        if (i == kCells || j == kCells) continue;
        const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = a + kCells + 1, d = c + 1;
        soup.triangles.push_back({a, b, d});
        soup.triangles.push_back({a, d, c});
      }
    }
    const TriangleMesh mesh(soup.points, soup.triangles);
    const Bounds box = shape.bounds();
    for (int k = 0; k < 150; ++k) {
      const Ray ray = random_line(random, box.center(), 0.3 * box.diagonal(), 10);
      const Hits a = hits_of(shape, ray), b = hits_of(mesh, ray);
      ++lines, several += a.size() > 1;
      if (a.size() != b.size()) {
        ++differing;
        continue;
      }
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::abs(dot(a[i].normal, ray.direction)) < 0.05) continue;
        EXPECT_LT(distance(a[i].point, b[i].point), 0.02);
        EXPECT_GT(dot(a[i].normal, b[i].normal), 0.9);
      }
    }
  }
  EXPECT_GT(several, lines / 20);
  EXPECT_LE(differing, lines / 50);
}

// A cubic curve, drawn out along y: a line across it meets it where the cubic has its zeros.
TEST(BezierTest, AFoldedRibbon) {
  const Bernstein<3> x{{0, 3, -2, 1}}, z{{0, 0, 1, 1}};
  const Bezier ribbon({patch([&](int i, int j) { return Vec3{x.c[i], j - 1.5, z.c[i]}; })});
  for (int k = 0; k < 2000; ++k) {
    const double place = -0.2 + 1.4 * k / 2000;
    std::vector<double> heights;
    find_zeros(x + -place, [&](double u) { heights.push_back(z(u)); });
    const Hits hits = hits_of(ribbon, {{place, 0.3, -5}, {0, 0, 1}});
    ASSERT_EQ(hits.size(), heights.size()) << place;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      EXPECT_NEAR(hits[i].point.z, heights[i], 1e-9);
      EXPECT_NEAR(hits[i].t, 5 + heights[i], 1e-9);
    }
  }
}

// Lines through the common edge of two patches, and through a corner, meet one or both.
TEST(BezierTest, NoLineSlipsThroughASeam) {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    const Points left = random_patch(random, 1);
    Points right = random_patch(random, 1);
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) right[4 * j + i].x += 3;
      right[4 * j] = left[4 * j + 3];
    }
    const Bezier both({left, right});
    for (int k = 0; k <= 200; ++k) {
      const Vec3 p = point_of(left, 1, k / 200.0);
      const Vec3 d = random_direction(random);
      EXPECT_FALSE(hits_of(both, {p - d * 7, d}).empty());
      EXPECT_TRUE(both.occludes({p - Vec3{0, 0, 1}, {0, 0, 2}}, 0, 1));
    }
  }
}

// The surface is cut into pieces: as many hits as the patch has in one piece, also through the
// cuts.
TEST(BezierTest, PiecesHaveTheHitsOfThePatch) {
  Random random(5);
  for (int round = 0; round < 20; ++round) {
    const Points points = random_patch(random, 2 + round % 4);
    const Bezier shape({points});
    EXPECT_GT(shape.part_count(), 1u);
    RationalPatch whole;
    for (std::size_t i = 0; i < 16; ++i) {
      for (int axis = 0; axis < 3; ++axis) whole.part[axis].c[i] = points[i][axis];
      whole.part[3].c[i] = 1;
    }
    const PatchPiece piece(whole);
    for (int k = 0; k < 200; ++k) {
      const Ray ray = random_line(random, shape.bounds().center(), 1.5, 5);
      std::vector<Place> places;
      piece.find(ray, places);
      EXPECT_EQ(hits_of(shape, ray).size(), places.size());
    }
    for (int k = 0; k <= 200; ++k) {
      const Vec3 d = random_direction(random);
      const double cut = 0.4937, along = k / 200.0;
      for (const Vec3& p : {point_of(points, cut, along), point_of(points, along, cut * cut)}) {
        EXPECT_FALSE(hits_of(shape, {p - d * 7, d}).empty());
      }
    }
  }
}

// z = x²: a line at the height ε over the valley meets it at ±√ε, one below it nowhere.
TEST(BezierTest, GrazingLines) {
  const double x[4] = {-1, -1.0 / 3, 1.0 / 3, 1}, z[4] = {1, -1.0 / 3, -1.0 / 3, 1};
  const Bezier valley({patch([&](int i, int j) { return Vec3{x[i], j - 1.5, z[i]}; })});
  for (double height = 0.1; height > 1e-11; height *= 0.3) {
    const Hits hits = hits_of(valley, {{-5, 0.1, height}, {1, 0.01, 0}});
    ASSERT_EQ(hits.size(), 2u) << height;
    EXPECT_NEAR(hits[0].point.x, -std::sqrt(height), 1e-15 / height + 1e-13);
    EXPECT_NEAR(hits[1].point.x, std::sqrt(height), 1e-15 / height + 1e-13);
    EXPECT_TRUE(hits_of(valley, {{-5, 0.1, -height}, {1, 0.01, 0}}).empty());
  }
}

// Eight patches whose poles are edges shrunk to a point; within 0.06 % of a unit sphere.
std::vector<Points> globe() {
  const double k = 4.0 / 3 * (std::sqrt(2.0) - 1);
  std::vector<Points> patches;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double c = std::round(std::cos(quarter * pi / 2)),
                 s = std::round(std::sin(quarter * pi / 2));
    const std::array<Vec3, 4> round = {
        Vec3{c, s, 0}, {c - k * s, s + k * c, 0}, {k * c - s, k * s + c, 0}, {-s, c, 0}};
    const double radius[4] = {1, 1, k, 0}, height[4] = {0, k, 1, 1};
    patches.push_back(patch([&](int i, int j) {
      return round[i] * radius[j] + Vec3{0, 0, height[j]};
    }));
    patches.push_back(patch([&](int i, int j) {
      return round[i] * radius[3 - j] - Vec3{0, 0, height[3 - j]};
    }));
  }
  return patches;
}

TEST(BezierTest, AGlobe) {
  const Bezier shape(globe());
  EXPECT_NEAR(*shape.area(), 4 * pi, 4 * pi * 6e-4);
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 d = random_direction(random);
    const Hits hits = hits_of(shape, {d * -3, d});
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_NEAR(length(hits[0].point), 1, 6e-4);
    EXPECT_LT(dot(hits[0].normal, d), -0.99);
    EXPECT_GT(dot(hits[1].normal, d), 0.99);
  }
  // Through both poles, where four patches meet.
  const Hits poles = hits_of(shape, {{0, 0, -3}, {0, 0, 1}});
  ASSERT_GE(poles.size(), 2u);
  EXPECT_LT(distance(poles.front().point, {0, 0, -1}), 1e-12);
  EXPECT_LT(distance(poles.back().point, {0, 0, 1}), 1e-12);
  EXPECT_LT(distance(poles.back().normal, {0, 0, 1}), 1e-4);
}

TEST(BezierTest, WhatIsNoPatchIsRefused) {
  const auto refusal = [](std::vector<Points> patches) -> std::string {
    try {
      const Bezier shape(std::move(patches));
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(refusal({}), "patches: must be one at least");
  EXPECT_EQ(refusal({Points(15)}), "patches: each has 16 points, not 15");
  const Points good = patch([](int i, int j) { return Vec3(i, j, 0); });
  const Points line = patch([](int i, int j) { return Vec3(i + j, 0, 0); });
  EXPECT_EQ(refusal({good, line}), "patches: number 2 has no area");
  EXPECT_NE(refusal({patch([](int, int) { return Vec3{1, 2, 3}; })}), "none");
  Points bad = good;
  bad[7].z = std::numeric_limits<double>::infinity();
  EXPECT_NE(refusal({bad}), "none");
}

}  // namespace
}  // namespace isolux
