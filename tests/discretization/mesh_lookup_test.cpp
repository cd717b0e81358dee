#include "isolux/discretization/mesh_lookup.h"

#include <gtest/gtest.h>

#include "isolux/core/random.h"
#include "support/meshes.h"
#include "support/scenes.h"

namespace isolux {
namespace {

Vec3 at(const Triangulation& mesh, const MeshPlace& place) {
  Vec3 sum;
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GE(place.weights[k], 0);
    sum += mesh.vertex(place.vertices[k]).position * place.weights[k];
  }
  EXPECT_NEAR(place.weights[0] + place.weights[1] + place.weights[2], 1, 1e-12);
  return sum;
}

TEST(MeshLookup, FindsThePointItselfOnFlatWalls) {
  const Triangulation mesh = box_room_mesh({1, 2, 3}, 9, gray(0.5));
  const MeshLookup lookup(mesh);
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    // On the floor, under the ceiling and on a wall: each has its own side of the mesh.
    const double a = 0.001 + 0.998 * random.uniform(), b = 0.001 + 0.998 * random.uniform();
    for (const auto& [point, normal] :
         {std::pair(Vec3{a, 2 * b, 0}, Vec3{0, 0, 1}), std::pair(Vec3{a, 2 * b, 3}, Vec3{0, 0, -1}),
          std::pair(Vec3{1, 2 * a, 3 * b}, Vec3{-1, 0, 0})}) {
      const auto place = lookup.covering(point, normal);
      ASSERT_TRUE(place);
      EXPECT_LT(distance(at(mesh, *place), point), 1e-6);
      EXPECT_FALSE(lookup.covering(point, -normal)) << "the other side is not covered";
    }
  }
}

TEST(MeshLookup, FineAndCoarsePartsAlike) {
  Triangulation mesh({1, 1e-9, 0.5}, {{0, 0, 0}, {2, 1, 1}});
  add_grid(mesh, {}, {1, 0, 0}, {0, 1, 0}, 2, {0, 0}, gray(0.5));
  add_grid(mesh, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, 150, {0, 0}, gray(0.5));
  const MeshLookup lookup(mesh);
  Random random(2);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 point{2 * random.uniform(), random.uniform(), 0};
    const auto place = lookup.place(point, {0, 0, 1});
    ASSERT_TRUE(place);
    EXPECT_LT(distance(at(mesh, *place), point), point.x < 1 ? 2e-3 : 2e-5);
  }
}

TEST(MeshLookup, OfTwoSheetsTheNearer) {
  Triangulation mesh({1, 1e-9, 0.5}, {{0, 0, 0}, {1, 1, 1}});
  add_grid(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, {0, 0}, gray(0.5));
  add_grid(mesh, {0, 0, 0.003}, {1, 0, 0}, {0, 1, 0}, 3, {1, 0}, gray(0.5));
  const MeshLookup lookup(mesh);
  for (const double z : {0.0, 0.003}) {
    const auto place = lookup.covering({0.4, 0.3, z}, {0, 0, 1});
    ASSERT_TRUE(place);
    EXPECT_DOUBLE_EQ(at(mesh, *place).z, z);
  }
}

TEST(MeshLookup, WithRaysNothingFromUnderTheSheetThatIsSeen) {
  // A lower sheet close under an upper, whose mesh has a hole.
  const auto sheet = [](const std::string& z) {
    return "  - {shape: {parallelogram: {corner: [0, 0, " + z +
           "], u: [1, 0, 0], v: [0, 1, 0]}}, material: m}\n";
  };
  const Scene scene =
      scene_of("materials: {m: {reflectance: 0.5}}\nobjects:\n" + sheet("0.003") + sheet("0"));
  const RayCaster rays(scene);
  Triangulation mesh({1, 1e-9, 0.5}, {{0, 0, 0}, {1, 1, 1}});
  add_grid(mesh, {0, 0, 0.003}, {0.4, 0, 0}, {0, 1, 0}, 3, {0, 0}, gray(0.5));
  add_grid(mesh, {0.6, 0, 0.003}, {0.4, 0, 0}, {0, 1, 0}, 3, {0, 0}, gray(0.5));
  add_grid(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, {1, 0}, gray(0.5));
  const Vec3 in_hole{0.5, 0.3, 0.003}, up{0, 0, 1};
  const auto under = MeshLookup(mesh).place(in_hole, up);
  ASSERT_TRUE(under);
  EXPECT_EQ(at(mesh, *under).z, 0);
  const auto seen = MeshLookup(mesh, &rays).place(in_hole, up);
  ASSERT_TRUE(seen);
  EXPECT_DOUBLE_EQ(at(mesh, *seen).z, 0.003);
}

TEST(MeshLookup, OfManyHitsEachInItsOwnObject) {
  Triangulation mesh({1, 1e-9, 0.5}, {{0, 0, 0}, {1, 1, 1}});
  add_grid(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 3, {0, 0}, gray(0.5));
  add_grid(mesh, {0, 0, 0.003}, {1, 0, 0}, {0, 1, 0}, 40, {1, 0}, gray(0.5));
  const MeshLookup lookup(mesh);
  Random random(3);
  constexpr std::uint32_t kNothing = 2, kWithoutTriangles = 3;
  std::vector<std::optional<SurfaceHit>> hits;
  for (std::uint32_t i = 0; i < 101; ++i) {
    SurfaceHit hit;
    hit.point = {random.uniform(), random.uniform(), i % 4 == 1 ? 0.003 : 0.0};
    hit.normal = {0, 0, 1};
    hit.surface.object = i % 4;
    hits.push_back(hit);
    if (i % 4 == kNothing) hits.back().reset();
  }
  std::vector<std::optional<MeshPlace>> places(hits.size());
  lookup.covering(hits, places);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    ASSERT_EQ(places[i].has_value(), hits[i].has_value());
    if (!hits[i]) continue;
    EXPECT_LT(distance(at(mesh, *places[i]), hits[i]->point), 1e-6) << i;
    const std::uint32_t object = hits[i]->surface.object;
    const std::uint32_t found = mesh.vertex(places[i]->vertices[0]).surface.object;
    EXPECT_EQ(found, object == kWithoutTriangles ? 0 : object);
  }
}

TEST(MeshLookup, WhereNoTriangleLiesTheNearestVerticesOfTheSameSideStandIn) {
  Triangulation mesh({0.3, 1e-9, 0.5}, {{0, 0, 0}, {1, 1, 1}});
  add_grid(mesh, {0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}, 4, {0, 0}, gray(0.5));
  add_grid(mesh, {0.8, 0, 0}, {0, 0.5, 0}, {0.2, 0, 0}, 4, {0, 1}, gray(0.5));
  const MeshLookup lookup(mesh);
  EXPECT_FALSE(lookup.covering({0.6, 0.2, 0}, {0, 0, 1}));
  for (const double x : {0.6, 0.79}) {
    const auto place = lookup.place({x, 0.2, 0}, {0, 0, 1});
    ASSERT_TRUE(place);
    EXPECT_LE(at(mesh, *place).x, 0.5) << "the nearer ones face down";
  }
  EXPECT_FALSE(lookup.place({0.5, 0.2, 0}, {1, 0, 0})) << "nothing faces that way";
}

TEST(MeshLookup, AnEmptyMeshHasNoPlaces) {
  const Triangulation mesh({1, 1e-3, 0.5}, {{0, 0, 0}, {1, 1, 1}});
  EXPECT_FALSE(MeshLookup(mesh).place({0, 0, 0}, {0, 0, 1}));
}

}  // namespace
}  // namespace isolux
