#include <gmock/gmock.h>

#include <numbers>

#include "scene/scene_text.h"

namespace isolux {
namespace {

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::acos(dot(a, b) / length(a) / length(b)) * 180 / std::numbers::pi;
}

TEST(Camera, RaysSpanTheFieldOfViewAroundTheView) {
  Camera camera{.name = "a", .eye = {1, 2, 3}, .look_at = {1, 12, 3}, .fov = 40};
  camera.width = 300;
  camera.height = 200;
  const Ray middle = camera.ray(0.5, 0.5);
  EXPECT_EQ(middle.origin, camera.eye);
  expect_near(middle.direction, {0, 1, 0});
  const Vec3 top = camera.ray(0.5, 0).direction, bottom = camera.ray(0.5, 1).direction;
  EXPECT_GT(top.z, 0);
  EXPECT_NEAR(degrees_between(top, bottom), 40, 1e-9);
  // Looking along +y with z up, right is +x; the picture is 1.5 times as wide as high.
  const Vec3 left = camera.ray(0, 0.5).direction, right = camera.ray(1, 0.5).direction;
  EXPECT_GT(right.x, 0);
  EXPECT_NEAR(std::tan(degrees_between(left, right) * std::numbers::pi / 360),
              1.5 * std::tan(20 * std::numbers::pi / 180), 1e-12);
  EXPECT_NEAR(length(camera.ray(0.1, 0.9).direction), 1, 1e-12);
}

TEST(Camera, UpNeedNotBeNormalToTheView) {
  Camera camera{.name = "a", .eye = {0, 0, 5}, .look_at = {1, 0, 0}, .up = {0, 0, 3}};
  const Vec3 top = camera.ray(0.5, 0.25).direction, middle = camera.ray(0.5, 0.5).direction;
  EXPECT_GT(top.z, middle.z);
  EXPECT_NEAR(top.y, 0, 1e-12);
}

TEST(Camera, IsReadWithItsDefaults) {
  const std::string cameras =
      "cameras:\n"
      "  first: {eye: [0, -2, 1 ft], look_at: [0, 0, 0]}\n"
      "  plan: {eye: [0, 0, 5], look_at: [0, 0, 0], up: y, fov: 30, size: [640, 480]}\n";
  const Scene scene = read_scene(
      scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n", cameras), "test.yaml");
  const Camera& first = scene.camera("");
  EXPECT_EQ(first.name, "first");
  expect_near(first.eye, {0, -2, 0.3048});
  EXPECT_EQ(first.up, (Vec3{0, 0, 1}));
  EXPECT_EQ(first.fov, 50);
  EXPECT_EQ(first.width, 800);
  EXPECT_EQ(first.height, 600);
  const Camera& plan = scene.camera("plan");
  EXPECT_EQ(plan.up, (Vec3{0, 1, 0}));
  EXPECT_EQ(plan.width, 640);
  try {
    scene.camera("pan");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'first' and 'plan'"));
  }
}

TEST(Camera, NoneAtAllIsSaidSo) { EXPECT_THROW(Scene{}.camera(""), InputError); }

}  // namespace
}  // namespace isolux
