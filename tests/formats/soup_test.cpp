#include "isolux/formats/soup.h"

#include <gmock/gmock.h>

#include "isolux/core/error.h"
#include "isolux/geometry/tessellation.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux {
namespace {

/// The twelve triangles of a unit cube, outward, each with points of its own, moved by up to
/// `jitter` (m).
TriangleSoup loose_cube(double jitter = 0) {
  const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  TriangleSoup soup;
  for (const auto& face : faces) {
    for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
      const auto n = static_cast<std::uint32_t>(soup.points.size());
      for (const int k : t) {
        const int i = face[k];
        const double off = jitter * ((n + k) % 3 - 1.0);
        soup.points.push_back({(i & 1) + off, (i >> 1 & 1) - off, (i >> 2) + off});
      }
      soup.triangles.push_back({n, n + 1, n + 2});
    }
  }
  return soup;
}

TEST(Soup, LoosePointsAreWelded) {
  for (const double jitter : {0.0, 2e-8}) {
    TriangleSoup soup = loose_cube(jitter);
    EXPECT_EQ(weld(soup).flat, 0u);
    EXPECT_EQ(soup.points.size(), 8u);
    const TriangleMesh cube(soup.points, soup.triangles);
    EXPECT_TRUE(cube.solid());
    EXPECT_FALSE(cube.unbounded());
    EXPECT_EQ(cube.face_count(), 6u);
  }
  TriangleSoup apart = loose_cube(1e-5);
  weld(apart);
  EXPECT_GT(apart.points.size(), 8u);
}

TEST(Soup, FlatAndRepeatedTrianglesAreLeftOut) {
  TriangleSoup soup{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}},
                    {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}, {1, 1, 2}}};
  const LeftOut left_out = weld(soup);
  EXPECT_EQ(left_out.flat, 2u);
  EXPECT_EQ(left_out.repeated, 1u);
  EXPECT_EQ(soup.triangles.size(), 1u);
  EXPECT_EQ(soup.points.size(), 3u);
}

TEST(Soup, WindingsAreMadeToAgree) {
  for (std::size_t mask = 1; mask < 4096; mask += 37) {
    TriangleSoup soup = loose_cube();
    weld(soup);
    for (std::size_t i = 0; i < 12; ++i) {
      if (mask >> i & 1) std::swap(soup.triangles[i][1], soup.triangles[i][2]);
    }
    agree(soup);
    const TriangleMesh cube(soup.points, soup.triangles);
    EXPECT_TRUE(cube.solid());
    EXPECT_FALSE(cube.unbounded());
  }
}

TEST(Soup, PiecesThatAgreeStayAsTheyAre) {
  TriangleSoup soup = loose_cube();
  weld(soup);
  flip(soup);
  const auto before = soup.triangles;
  agree(soup);
  EXPECT_EQ(soup.triangles, before);
}

TEST(Soup, PolygonsAreCutWithoutLosingArea) {
  // An L of three unit squares, a bent quadrilateral, a star that crosses itself.
  TriangleSoup soup{{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, {}};
  Cutting cutting;
  add_polygon(soup, {0, 1, 2, 3, 4, 5}, cutting);
  EXPECT_EQ(soup.triangles.size(), 4u);
  EXPECT_NEAR(area(soup), 3, 1e-12);

  TriangleSoup arrow{{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {1, 1, 0}}, {}};  // concave at the last
  add_polygon(arrow, {0, 1, 2, 3}, cutting);
  EXPECT_NEAR(area(arrow), 1, 1e-12);
  EXPECT_EQ(cutting.uncertain, 0u);

  Cutting spent{1e8, 0};
  EXPECT_THROW(add_polygon(soup, {0, 1, 2, 3, 4, 5}, spent), InputError);
}

}  // namespace
}  // namespace isolux
