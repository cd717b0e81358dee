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

double illuminance(const Source& source, const Vec3& p) {
  if (source.kind == Source::Kind::directional) return luminance(source.intensity);
  const Vec3 d = p - source.position;
  return luminance(source.intensity) * source.beam(normalized(d)) / length_squared(d);
}

// A perfectly white surface there has then the luminance 1 cd/m², what Rayshade would call 1.
TEST(RayshadeLights, GivePiLuxAtTheMiddleOfTheScene) {
  const std::string ball = "sphere 1 5 6 7\n";
  const Vec3 middle{5, 6, 7};
  for (const char* light : {
           "light 1 point 5 6 30", "light 1 directional 1 2 3", "light 1 spot 25 6 7 5 6 7 1",
           "light 1 spot 25 6 7 5 6 7 1 10 20", "",  // Rayshade's own
       }) {
    SCOPED_TRACE(light);
    const Scene scene = rayshade_scene(ball + light);
    EXPECT_EQ(scene.objects.size(), 1u);
    ASSERT_EQ(scene.sources.size(), 1u);
    EXPECT_NEAR(illuminance(scene.sources[0], middle), pi, 1e-9);
  }
  for (const char* light :
       {"light 1 extended .5 15 6 7",
        "light 1 area 4 5 37 6 5 37 3 4 7 37 3",  // its front is turned to the scene
        "light 1 area 4 5 37 4 7 37 3 6 5 37 3 noshadow"}) {
    SCOPED_TRACE(light);
    const Scene scene = rayshade_scene(ball + light);
    ASSERT_EQ(scene.objects.size(), 2u);
    ASSERT_TRUE(scene.objects[1].emits());
    EXPECT_EQ(max_channel(scene.material_of(1).reflectance), 0);
    EXPECT_NEAR(illuminance(scene.objects[1], middle), pi, 0.01 * pi);
  }
}

TEST(RayshadeLights, ComeWhereTheyShould) {
  const auto scene = [](const std::string& light) {
    return rayshade_scene("sphere 1 0 0 0 eyep 0 -10 0 light 1 " + light);
  };
  EXPECT_EQ(scene("point 0 0 5").sources.at(0).position, (Vec3{0, 0, 5}));
  expect_near(scene("extended .5 0 0 5").objects.at(1).shape->bounds().upper, {.5, .5, 5.5});
  expect_near(scene("directional 0 3 4").sources.at(0).direction, {0, -0.6, -0.8});
  const Bounds quad = scene("area -1 -1 5 1 -1 5 2 -1 1 5 2").objects.at(1).shape->bounds();
  expect_near(quad.lower, {-1, -1, 5});
  expect_near(quad.upper, {1, 1, 5});
}

TEST(RayshadeLights, SpotsKeepToTheirCone) {
  const Scene scene =
      rayshade_scene("sphere 1 0 0 0 light 1 spot 0 0 5 0 0 0 2 15 30\nlight 1 spot 0 0 9 0 0 0 1");
  const Source& narrow = scene.sources.at(0);
  EXPECT_EQ(narrow.full_angle, 15);
  EXPECT_EQ(narrow.dark_angle, 30);
  expect_near(narrow.direction, {0, 0, -1});
  EXPECT_EQ(scene.sources.at(1).dark_angle, 90);
}

TEST(RayshadeLights, HaveTheirColor) {
  const Scene scene =
      rayshade_scene("sphere 1 0 0 0 light .2 .4 .8 point 0 0 5 light 0 point 1 0 9");
  ASSERT_EQ(scene.sources.size(), 1u) << "the dark one is none";
  const Rgb intensity = scene.sources[0].intensity;
  EXPECT_NEAR(intensity.g / intensity.r, 2, 1e-12);
  EXPECT_NEAR(intensity.b / intensity.r, 4, 1e-12);
}

}  // namespace
}  // namespace isolux
