#include "isolux/discretization/nearest_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "isolux/core/random.h"

namespace isolux {
namespace {

/// A mesh of lone triangles of all sizes, facing all ways.
Triangulation scattered(std::size_t count) {
  Triangulation mesh({2.0}, {{-2, -2, -2}, {2, 2, 2}});  // δ: more than their distances
  Random random(1, 0);
  const auto anywhere = [&] {
    return Vec3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 corner = anywhere();
    const double size = std::pow(10, -4 * random.uniform());
    std::array<VertexId, 3> corners;
    for (VertexId& v : corners) {
      Vertex vertex;
      vertex.position = corner + anywhere() * size;
      vertex.normal = normalized(anywhere());
      v = mesh.restore_vertex(std::move(vertex));
    }
    mesh.restore_triangle(corners, {}, {}, false);
  }
  return mesh;
}

TEST(NearestVertices, AreThoseThatASearchThroughAllFinds) {
  const Triangulation mesh = scattered(500);
  const NearestVertices nearest(mesh);
  Random random(2, 0);
  for (int i = 0; i < 200; ++i) {
    const Vec3 point{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5};
    const Vec3 normal = normalized(point + Vec3{0, 0, 1e-3});
    std::vector<std::pair<double, VertexId>> all;
    for (VertexId v = 0; v < mesh.vertices().size(); ++v) {
      if (dot(mesh.vertex(v).normal, normal) < 0.5) continue;
      all.emplace_back(distance(mesh.vertex(v).position, point), v);
    }
    std::sort(all.begin(), all.end());
    const auto place = nearest.place(point, normal);
    ASSERT_TRUE(place);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(place->vertices[k], all[k].second);
      const double ratio = all[0].first / all[k].first;
      EXPECT_NEAR(place->weights[k] / place->weights[0], ratio * ratio, 1e-9);
    }
  }
}

TEST(NearestVertices, FurtherAwayThanTheLongestEdgeAreNone) {
  Triangulation mesh({0.5}, {{-1, -1, -1}, {1, 1, 1}});
  std::array<VertexId, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    Vertex vertex;
    vertex.position = {k == 1 ? 0.3 : 0, k == 2 ? 0.3 : 0, 0};
    vertex.normal = {0, 0, 1};
    corners[k] = mesh.restore_vertex(std::move(vertex));
  }
  mesh.restore_triangle(corners, {}, {}, false);
  const NearestVertices nearest(mesh);
  EXPECT_TRUE(nearest.place({-0.4, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(nearest.place({-0.6, 0, 0}, {0, 0, 1}));
}

TEST(NearestVertices, OfAnEmptyMeshAreNone) {
  EXPECT_FALSE(NearestVertices(Triangulation({}, {})).place({}, {0, 0, 1}));
}

}  // namespace
}  // namespace isolux
