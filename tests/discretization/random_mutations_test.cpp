#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/core/random.h"
#include "isolux/discretization/mesh_rays.h"
#include "support/scenes.h"

namespace isolux {
namespace {

struct Case {
  std::string name;
  std::string scene;
  double delta;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const Case kCases[] = {
    {"sphere", "objects: [{shape: {sphere: {center: [0, 0, 0], radius: 1}}, material: m}]", 0.3},
    {"torus",
     "objects: [{shape: {torus: {center: [0, 0, 0], axis: [0, 0, 1], major_radius: 1, "
     "minor_radius: 0.4}}, material: m}]",
     0.3},
    {"csg",
     "objects: [{shape: {difference: [{intersection: [{box: {lower: [-1, -1, -1], upper: [1, 1, "
     "1]}}, {sphere: {center: [0, 0, 0], radius: 1.3}}]}, {cylinder: {from: [0, 0, -2], to: [0, "
     "0, 2], radius: 0.5}}]}, material: m}]",
     0.3},
    {"room", "", 0.15},
};

class RandomMutations : public testing::TestWithParam<Case> {};

/// At least 10⁴ operations, each at a point that a random ray finds; every invariant is checked
/// after each of the first hundred and then now and again.
TEST_P(RandomMutations, KeepEveryInvariant) {
  const Scene scene = GetParam().scene.empty()
                          ? paper_room()
                          : scene_of("materials: {m: {reflectance: 0.5}}\n" + GetParam().scene);
  const RayCaster rays(scene);
  const Bounds bounds = scene.bounds();
  Triangulation mesh({GetParam().delta, 1e-5, 0.5}, bounds);
  MeshRays mesh_rays(mesh);
  Random random(11);
  std::vector<SurfaceHit> hits;
  std::vector<MeshHit> mesh_hits;
  int operations = 0, extended = 0, split = 0, removed = 0;

  const auto check = [&] {
    if (operations < 100 || operations % 500 == 0) {
      ASSERT_THAT(mesh.validate(), testing::IsEmpty()) << "after operation " << operations;
    }
  };
  const auto random_point = [&] {
    const Vec3 s = bounds.upper - bounds.lower;
    return bounds.lower +
           Vec3{s.x * random.uniform(), s.y * random.uniform(), s.z * random.uniform()};
  };
  while (operations < 10000) {
    const Vec3 from = random_point();
    const Ray ray{from, normalized(random_point() - from)};
    rays.all_hits(ray, {}, hits);
    mesh_rays.update();
    mesh_rays.all_hits(ray, {}, mesh_hits);
    for (const SurfaceHit& hit : hits) {
      const SurfacePoint point{hit.point, hit.normal, hit.surface, gray(0.5)};
      const double choice = random.uniform();
      if (choice < 0.5 || mesh_hits.empty()) {
        extended += mesh.extend(point).has_value();
      } else if (choice < 0.85) {
        for (const MeshHit& mesh_hit : mesh_hits) {
          if (std::abs(mesh_hit.t - hit.t) < 0.05 && mesh.split(mesh_hit.triangle, point)) ++split;
        }
      } else {
        mesh.remove(mesh_hits[random.below(mesh_hits.size())].triangle);
        ++removed;
      }
      ++operations;
      check();
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(extended, 300);
  EXPECT_GT(split, 100);
  EXPECT_GT(removed, 500);
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Zoo, RandomMutations, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace isolux
