#include "isolux/formats/default_camera.h"

#include <gtest/gtest.h>

#include "formats/mgf_text.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/sphere.h"

namespace isolux {
namespace {

std::shared_ptr<const Shape> box(const Vec3& lower, const Vec3& upper) {
  return std::make_shared<Box>(lower, upper);
}

Object object(std::shared_ptr<const Shape> shape, double exitance = 0) {
  Object o;
  o.shape = std::move(shape);
  o.exitance = gray(exitance);
  return o;
}

/// A closed room of 4 by 6 by 2.7 m with a light below its ceiling.
Scene room() {
  Scene scene;
  scene.objects.push_back(object(std::make_shared<Complement>(box({}, {4, 6, 2.7}))));
  scene.objects.push_back(
      object(std::make_shared<Disk>(Vec3{2, 3, 2.6}, Vec3{0, 0, -1}, 0.3), 1000));
  return scene;
}

bool sees(const Scene& scene, const Camera& camera, const Vec3& point) {
  for (const Object& o : scene.objects) {
    if (o.shape->occludes({camera.eye, point - camera.eye}, 0, 1)) return false;
  }
  return true;
}

TEST(DefaultCamera, StandsInACornerOfARoomAtEyeHeight) {
  const Camera camera = default_camera(room());
  EXPECT_EQ(camera.name, "default");
  expect_near(camera.eye, {0.4, 0.6, 1.6});
  expect_near(camera.look_at, {2, 3, 1.35});
  expect_near(camera.up, {0, 0, 1});
}

TEST(DefaultCamera, ChoosesTheCornerWithTheWidestView) {
  Scene scene = room();
  scene.objects.push_back(object(box({0.1, 0.1, 0}, {0.8, 1.5, 2})));  // a cupboard
  scene.objects.push_back(object(box({2.5, 0.5, 0.5}, {3, 3, 2})));    // a screen
  scene.objects.push_back(object(box({1, 4, 0}, {1.5, 5.9, 2.7})));    // a pillar
  expect_near(default_camera(scene).eye, {3.6, 5.4, 1.6});
  EXPECT_TRUE(sees(scene, default_camera(scene), {2, 3, 1.35}));
}

TEST(DefaultCamera, LooksAtAThingFromOutside) {
  Scene scene;
  scene.objects.push_back(object(std::make_shared<Sphere>(Vec3{1, 2, 3}, 0.5)));
  const Camera camera = default_camera(scene);
  EXPECT_GT(distance(camera.eye, {1, 2, 3}), 1.5);
  EXPECT_GT(camera.eye.z, 3);
  expect_near(camera.look_at, {1, 2, 3});
}

TEST(DefaultCamera, LampsHangFromCeilings) {
  EXPECT_EQ(guessed_up_axis(room()), 2);
  Scene scene;
  scene.objects.push_back(object(std::make_shared<Complement>(box({}, {4, 2.7, 6}))));
  EXPECT_EQ(guessed_up_axis(scene), 2);  // no light: by custom
  scene.objects.push_back(
      object(std::make_shared<Disk>(Vec3{2, 2.6, 4}, Vec3{0, -1, 0}, 0.3), 1000));
  EXPECT_EQ(guessed_up_axis(scene), 1);
  const Camera camera = default_camera(scene);
  expect_near(camera.up, {0, 1, 0});
  EXPECT_DOUBLE_EQ(camera.eye.y, 1.6);
}

TEST(DefaultCamera, FlatScenesHaveOneToo) {
  Scene scene;
  scene.objects.push_back(object(std::make_shared<Disk>(Vec3{}, Vec3{0, 0, 1}, 1), 10));
  const Camera camera = default_camera(scene);
  EXPECT_TRUE(is_finite(camera.eye));
  EXPECT_GT(length(cross(camera.look_at - camera.eye, camera.up)), 0.1);
}

}  // namespace
}  // namespace isolux
