#include <gtest/gtest.h>

#include <numbers>

#include "formats/rayshade_text.h"

namespace isolux {
namespace {

using std::numbers::pi;

/// The illuminance (lx) that a lamp makes at p on a surface that faces it, summed over small
/// triangles.
double illuminance(const Object& lamp, const Vec3& p) {
  const Vec3 towards = normalized(lamp.shape->bounds().center() - p);
  const auto soup = lamp.shape->triangulate(lamp.shape->bounds().diagonal() / 60);
  double sum = 0;
  for (const auto& [i, j, k] : soup->triangles) {
    const Vec3 a = soup->points[i], b = soup->points[j], c = soup->points[k];
    const Vec3 area = cross(b - a, c - a) * 0.5, to_lamp = (a + b + c) / 3 - p;
    const double d2 = length_squared(to_lamp);
    const double shines = -dot(area, to_lamp), receives = dot(towards, to_lamp);
    if (shines > 0 && receives > 0) sum += shines * receives / (pi * d2 * d2);
  }
  return sum * luminance(lamp.exitance);
}

// A perfectly white surface there has then the luminance 1 cd/m², what Rayshade would call 1.
TEST(RayshadeLights, GivePiLuxAtTheMiddleOfTheScene) {
  const std::string ball = "sphere 1 5 6 7\n";
  struct Case {
    const char* light;
    double tolerance;
  };
  const Case cases[] = {
      {"light 1 point 5 6 30", 0.01},
      {"light 1 extended .5 15 6 7", 0.01},
      {"light 1 directional 1 2 3", 0.01},
      {"light 1 spot 25 6 7 5 6 7 1", 0.01},
      {"light 1 area 4 5 37 6 5 37 3 4 7 37 3", 0.01},  // its front is turned to the scene
      {"light 1 area 4 5 37 4 7 37 3 6 5 37 3 noshadow", 0.01},
      {"", 0.01},  // Rayshade's own
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.light);
    const Scene scene = rayshade_scene(ball + c.light);
    ASSERT_EQ(scene.objects.size(), 2u);
    ASSERT_TRUE(scene.objects[1].emits());
    EXPECT_EQ(max_channel(scene.material_of(1).reflectance), 0);
    EXPECT_NEAR(illuminance(scene.objects[1], {5, 6, 7}), pi, c.tolerance * pi);
  }
}

TEST(RayshadeLights, ComeWhereTheyShould) {
  const auto lamp = [](const std::string& light) {
    return rayshade_scene("sphere 1 0 0 0 eyep 0 -10 0 light 1 " + light).objects.at(1);
  };
  expect_near(lamp("point 0 0 5").shape->bounds().center(), {0, 0, 5});
  expect_near(lamp("extended .5 0 0 5").shape->bounds().upper, {.5, .5, 5.5});
  const Vec3 far = lamp("directional 0 3 4").shape->bounds().center();
  EXPECT_NEAR(angle_between(far, {0, 3, 4}), 0, 1e-12);
  EXPECT_GT(length(far), 50);
  const Bounds quad = lamp("area -1 -1 5 1 -1 5 2 -1 1 5 2").shape->bounds();
  expect_near(quad.lower, {-1, -1, 5});
  expect_near(quad.upper, {1, 1, 5});
}

TEST(RayshadeLights, HaveTheirColor) {
  const Scene scene =
      rayshade_scene("sphere 1 0 0 0 light .2 .4 .8 point 0 0 5 light 0 point 1 0 9");
  ASSERT_EQ(scene.objects.size(), 2u) << "the dark one is no object";
  const Rgb m = scene.objects[1].exitance;
  EXPECT_NEAR(m.g / m.r, 2, 1e-12);
  EXPECT_NEAR(m.b / m.r, 4, 1e-12);
}

TEST(RayshadeLights, SmallSpheresKeepClearOfSurfaces) {
  const Scene scene =
      rayshade_scene("box -5 -5 0 5 5 10 translate 0 0 0.002 light 1 point 0 0 0\neyep 0 -30 0");
  const Bounds lamp = scene.objects[1].shape->bounds();
  EXPECT_LE(lamp.upper.z, 0.002);
  EXPECT_GT(lamp.upper.z, 0.0005);
}

}  // namespace
}  // namespace isolux
