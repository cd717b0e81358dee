#include "isolux/radiosity/bright_places.h"

#include <gtest/gtest.h>

#include "isolux/core/random.h"
#include "support/meshes.h"

namespace isolux {
namespace {

TEST(BrightPlaces, ConesHoldAllThatIsTurnedToTheReceiver) {
  // A box seen from its inside; bright are some parts of its walls.
  const Triangulation mesh = box_room_mesh({2, 1, 1}, 9, gray(0.5));
  std::vector<double> radiosity(mesh.triangles().size());
  Random random(1, 2);
  for (double& b : radiosity) b = random.uniform() < 0.05 ? 5 + random.uniform() : 1;
  const BrightPlaces places(mesh, radiosity, 4);
  ASSERT_FALSE(places.empty());
  std::vector<BrightPlaces::Cone> cones;
  for (int i = 0; i < 200; ++i) {
    // Also from outside, where walls show their backs.
    const Vec3 point{4 * random.uniform() - 1, 2 * random.uniform() - 0.5,
                     2 * random.uniform() - 0.5};
    const Vec3 normal =
        normalized({random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5});
    const double fine = 0.02 + 0.2 * random.uniform();
    places.seen_from(point, normal, 0, fine, cones);
    for (TriangleId id = 0; id < radiosity.size(); ++id) {
      if (radiosity[id] <= 4) continue;
      const Triangle& triangle = mesh.triangle(id);
      Vec3 middle;
      double size = 0;
      for (const VertexId v : triangle.vertices) middle += mesh.vertex(v).position / 3;
      for (const VertexId v : triangle.vertices) {
        size = std::max(size, distance(mesh.vertex(v).position, middle));
      }
      const Vec3 towards = middle - point;
      if (length(towards) < 2 * size) continue;  // nearer than its own size
      if (dot(towards, normal) <= 0 || dot(towards, triangle.normal) >= 0) continue;
      const bool held = std::any_of(cones.begin(), cones.end(), [&](const auto& cone) {
        return distance(normalized(towards), cone.direction) <= cone.chord &&
               cone.radiosity >= radiosity[id];
      });
      EXPECT_TRUE(held) << i << " " << id;
    }
  }
}

TEST(BrightPlaces, NothingIsSeenFromBehindNorBelowTheHorizon) {
  const Triangulation mesh = box_room_mesh({1, 1, 1}, 4, gray(0.5));
  std::vector<double> radiosity(mesh.triangles().size());
  for (TriangleId id = 0; id < radiosity.size(); ++id) {
    radiosity[id] = mesh.triangle(id).normal.z < -0.9 ? 9 : 1;  // the ceiling
  }
  const BrightPlaces places(mesh, radiosity, 4);
  std::vector<BrightPlaces::Cone> cones;
  places.seen_from({0.5, 0.5, 0}, {0, 0, 1}, 0, 0.05, cones);
  EXPECT_FALSE(cones.empty());
  places.seen_from({0.5, 0.5, 0}, {0, 0, -1}, 0, 0.05, cones);
  EXPECT_TRUE(cones.empty());
  places.seen_from({0.5, 0.5, 3}, {0, 0, -1}, 0, 0.05, cones);
  EXPECT_TRUE(cones.empty());
}

}  // namespace
}  // namespace isolux
