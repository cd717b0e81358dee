#include "isolux/geometry/tessellation.h"

#include <gtest/gtest.h>

#include <map>

#include "geometry/zoo.h"
#include "isolux/core/error.h"
#include "isolux/geometry/frustum.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/sphere.h"

namespace isolux {
namespace {

TEST(TessellationTest, TrianglesHaveTheAreaOfTheSurface) {
  int cut = 0;
  for (const Specimen& s : zoo()) {
    for (const double max_edge : {100.0, 0.31, 0.1}) {
      SCOPED_TRACE(s.name);
      const auto soup = s.shape->triangulate(max_edge);
      if (!soup) continue;
      ++cut;
      if (s.shape->area()) {
        EXPECT_NEAR(area(*soup), *s.shape->area(), 1e-9 * area(*soup));
      }
      for (const auto& t : soup->triangles) {
        for (int i = 0; i < 3; ++i) {
          // Diagonals and the distortion of curved pieces.
          EXPECT_LT(distance(soup->points[t[i]], soup->points[t[(i + 1) % 3]]), 1.7 * max_edge);
        }
      }
    }
  }
  EXPECT_GE(cut, 3 * 15);
}

TEST(TessellationTest, TrianglesFaceAndFollowTheSurface) {
  for (const Specimen& s : zoo()) {
    const auto soup = s.shape->triangulate(0.2);
    if (!soup || s.name == "MeshInstance") continue;
    SCOPED_TRACE(s.name);
    for (const auto& [a, b, c] : soup->triangles) {
      const Vec3 &p = soup->points[a], &q = soup->points[b], &r = soup->points[c];
      const Vec3 normal = normalized(cross(q - p, r - p)), center = (p + q + r) / 3;
      EXPECT_NEAR(s.level(center), 0, 0.02);
      Hits hits = hits_of(*s.shape, {center, normal});
      // Caps and sides are scaled apart, so that a centre at a rim may miss its own piece.
      std::erase_if(hits, [](const Hit& h) { return std::abs(h.t) > 0.02; });
      double best = -1;
      for (const Hit& h : hits) best = std::max(best, dot(h.normal, normal));
      if (!hits.empty()) {
        EXPECT_GT(best, 0.9);
      }
    }
  }
}

TEST(TessellationTest, SquaresAreCutAsDocumented) {
  const auto triangles = [](double side, double max_edge) {
    const Parallelogram square({}, {side, 0, 0}, {0, side, 0});
    return square.triangulate(max_edge)->triangles.size();
  };
  EXPECT_EQ(triangles(0.1, 0.1), 2u);
  EXPECT_EQ(triangles(0.1 * 3, 0.1), 18u);  // 0.30000000000000004
  EXPECT_EQ(triangles(0.11, 0.1), 8u);
  EXPECT_EQ(triangles(1, std::numeric_limits<double>::infinity()), 2u);
}

TEST(TessellationTest, ClosedSurfacesShareTheirEdges) {
  const TriangleSoup soup = *Sphere({}, 1).triangulate(0.13);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : soup.triangles) {
    for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_EQ(soup.points.size() + soup.triangles.size(), edges.size() / 2 + 2);  // Euler
}

TEST(TessellationTest, CirclesHaveAtLeast32Segments) {
  const Frustum pipe({}, {0, 0, 1}, 1, 0.5, false);
  EXPECT_EQ(pipe.triangulate(100)->triangles.size(), 64u);
  EXPECT_GT(pipe.triangulate(0.1)->triangles.size(), 64u * 10);
}

TEST(TessellationTest, RefusesTooManyTriangles) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Specimen& s : zoo()) {
    if (!s.shape->triangulate(1)) continue;
    SCOPED_TRACE(s.name);
    for (const double max_edge : {0.0, -1.0, nan, 1e-9, 1e-300}) {
      EXPECT_THROW(s.shape->triangulate(max_edge), InputError) << max_edge;
    }
  }
}

}  // namespace
}  // namespace isolux
