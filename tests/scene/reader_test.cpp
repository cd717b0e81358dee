#include <gmock/gmock.h>

#include <filesystem>

#include "isolux/core/file.h"
#include "scene/scene_text.h"

namespace isolux {
namespace {
namespace fs = std::filesystem;

const fs::path kExamples = fs::path(ISOLUX_SOURCE_DIR) / "examples";

TEST(Reader, TheRoomIsThatOfThePaper) {
  const Scene scene = load_scene(kExamples / "lalonde1993/room.yaml");
  EXPECT_EQ(scene.source, read_file(kExamples / "lalonde1993/room.yaml"));
  ASSERT_EQ(scene.objects.size(), 4u);
  expect_near(scene.bounds().lower, {0, 0, 0});
  expect_near(scene.bounds().upper, {1, 1, 1});
  const Object &room = scene.objects[0], &pedestal = scene.objects[1], &ball = scene.objects[2],
               &light = scene.objects[3];
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scene.material_of(i).reflectance, gray(0.6));
    EXPECT_EQ(scene.objects[i].sides, Sides::front);
    EXPECT_FALSE(scene.objects[i].emits());
  }
  EXPECT_FALSE(room.shape->contains({0.5, 0.5, 0.9}));
  EXPECT_TRUE(room.shape->contains({0.5, 0.5, 1.1}));
  // The ball of 10 cm rests on the pedestal of 10 by 30 cm.
  expect_near(pedestal.shape->bounds().lower, {0.45, 0.45, 0});
  expect_near(pedestal.shape->bounds().upper, {0.55, 0.55, 0.3});
  expect_near(ball.shape->bounds().lower, {0.45, 0.45, 0.3});
  expect_near(ball.shape->bounds().upper, {0.55, 0.55, 0.4});
  // The light shines down from the ceiling.
  EXPECT_EQ(scene.material_of(3).reflectance, gray(0));
  EXPECT_NEAR(surface_area(*light.shape).value(), 0.01, 1e-15);
  EXPECT_NEAR(light.exitance.g, 50'000, 1e-6);
  EXPECT_EQ(light.sides, Sides::front);
  Hits hits;
  light.shape->intersect({{0.5, 0.5, 0.5}, {0, 0, 1}}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].point.z, 1);
  expect_near(hits[0].normal, {0, 0, -1});
  const Camera& camera = scene.camera("paper");
  expect_near(camera.look_at - camera.eye, {0, 1, -0.25});
  EXPECT_EQ(camera.fov, 75);
  EXPECT_EQ(camera.width, 1024);
  EXPECT_EQ(camera.height, 1024);
}

TEST(Reader, AllExamplesAreScenesWithLightAndCamera) {
  for (const auto& entry : fs::recursive_directory_iterator(kExamples)) {
    if (entry.path().extension() != ".yaml") continue;
    if (entry.path().stem().extension() == ".lights") continue;  // beside a model of another format
    SCOPED_TRACE(entry.path().string());
    const Scene scene = load_scene(entry.path());
    EXPECT_FALSE(scene.cameras.empty());
    EXPECT_TRUE(scene.has_light());
  }
}

TEST(Reader, SidesDefaultToBothForOpenShapesAlone) {
  EXPECT_EQ(read_object("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n").sides,
            Sides::front);
  const std::string disk = "    shape: {disk: {center: [0, 0, 0], normal: z, radius: 1}}\n";
  EXPECT_EQ(read_object(disk).sides, Sides::both);
  EXPECT_EQ(read_object(disk + "    sides: front\n").sides, Sides::front);
}

TEST(Reader, MaterialsAreFoundByName) {
  const Scene scene = read_scene(
      "isolux: 1\n"
      "name: two\n"
      "materials: {red: {reflectance: [0.5, 0.1, 0]}, 'off white': {reflectance: 0.8}}\n"
      "objects:\n"
      "  - {material: off white, shape: {sphere: {center: [0, 0, 0], radius: 1}}}\n"
      "  - {material: red, shape: {sphere: {center: [3, 0, 0], radius: 1}}, name: ball}\n",
      "test.yaml");
  EXPECT_EQ(scene.name, "two");
  EXPECT_EQ(scene.material_of(0).reflectance, gray(0.8));
  EXPECT_EQ(scene.material_of(1).reflectance, (Rgb{0.5, 0.1, 0}));
  EXPECT_EQ(scene.objects[0].name, "sphere 1");
  EXPECT_EQ(scene.objects[1].name, "ball");
}

TEST(Reader, MarkAndLineEndsOfOtherSystemsAreRead) {
  std::string text = "\xef\xbb\xbf";
  for (const char c : scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n")) {
    if (c == '\n') text += '\r';
    text += c;
  }
  EXPECT_EQ(refusal(text), "");
}

}  // namespace
}  // namespace isolux
