#include "isolux/discretization/coarsen.h"

#include <gtest/gtest.h>

#include <set>

#include "isolux/discretization/cover.h"
#include "support/scenes.h"

namespace isolux {
namespace {

constexpr int kLevels = 4;

Triangulation covered(const Scene& scene, double spacing) {
  const RayCaster rays(scene);
  Triangulation mesh({2.2 * spacing, 1e-9, 0.5}, scene.bounds());
  cover(mesh, rays, {spacing, 1});
  return mesh;
}

void expect_ordered_places(const Triangulation& mesh, const Coarsening& coarse) {
  ASSERT_EQ(coarse.order.size(), mesh.vertices().size());
  ASSERT_EQ(coarse.places.size(), mesh.vertices().size());
  std::set<VertexId> before;
  for (const VertexId v : coarse.order) {
    const auto& [among, weights] = coarse.places[v];
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE(weights[k], 0);
      sum += weights[k];
      EXPECT_TRUE(weights[k] == 0 || before.contains(among[k])) << v;
    }
    EXPECT_TRUE(sum == 0 || std::abs(sum - 1) < 1e-12) << v;
    EXPECT_TRUE(before.insert(v).second) << v;
  }
}

std::size_t coarsest(const Coarsening& coarse) {
  return static_cast<std::size_t>(std::count_if(
      coarse.places.begin(), coarse.places.end(),
      [](const MeshPlace& place) { return place.weights == std::array<double, 3>{}; }));
}

TEST(Coarsen, FlatSurfacesReproduceLinearFunctions) {
  const Scene scene = scene_of(
      "materials: {m: {reflectance: 0.5}}\nobjects: [{shape: {box: {lower: [0, 0, 0], upper: [1, "
      "2, 1], inward: true}}, material: m}]");
  const Triangulation mesh = covered(scene, 0.1);
  const Coarsening coarse = coarsen(mesh, kLevels);
  expect_ordered_places(mesh, coarse);
  EXPECT_LT(coarsest(coarse), mesh.vertices().size() / 15);
  for (VertexId v = 0; v < mesh.vertices().size(); ++v) {
    const auto& [among, weights] = coarse.places[v];
    if (weights[0] == 0) continue;
    Vec3 at;
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      at += mesh.vertex(among[k]).position * weights[k];
      if (weights[k] == 0) continue;
      EXPECT_GT(dot(mesh.vertex(among[k]).normal, mesh.vertex(v).normal), 0.999);
      size = std::max(size, distance(mesh.vertex(among[k]).position, mesh.vertex(v).position));
    }
    // Between two it may lie a little to one side of their line.
    EXPECT_LT(distance(at, mesh.vertex(v).position), weights[2] > 0 ? 1e-9 : 0.25 * size);
  }
}

TEST(Coarsen, CurvedSurfacesKeepToVerticesThatFaceAlike) {
  const Scene scene = scene_of(
      "materials: {m: {reflectance: 0.5}}\nobjects: [{shape: {torus: {center: [0, 0, 0], axis: z, "
      "major_radius: 1, minor_radius: 0.4}}, material: m}]");
  const Triangulation mesh = covered(scene, 0.1);
  const Coarsening coarse = coarsen(mesh, kLevels);
  expect_ordered_places(mesh, coarse);
  EXPECT_LT(coarsest(coarse), mesh.vertices().size() / 4);
  for (VertexId v = 0; v < mesh.vertices().size(); ++v) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (coarse.places[v].weights[k] == 0) continue;
      EXPECT_GT(dot(mesh.vertex(coarse.places[v].vertices[k]).normal, mesh.vertex(v).normal), 0.6);
    }
  }
}

TEST(Coarsen, AMeshOfNothingIsNoTrouble) {
  const Triangulation mesh({0.1, 1e-9, 0.5}, {{0, 0, 0}, {1, 1, 1}});
  const Coarsening coarse = coarsen(mesh, kLevels);
  EXPECT_TRUE(coarse.order.empty());
  EXPECT_TRUE(coarse.places.empty());
}

}  // namespace
}  // namespace isolux
