// Parts of a solid that look different.
#include "isolux/scene/finish.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "isolux/scene/writer.h"
#include "scene_text.h"

namespace isolux {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

const std::string kMaterials =
    "materials: {clay: {reflectance: 0.3}, glaze: {reflectance: 0.8}, lamp: {reflectance: 0}}\n";

/// A scene of one object in clay, of that shape.
std::string clay(const std::string& shape, const std::string& more = "") {
  return "isolux: 1\n" + kMaterials + more + "objects:\n  - name: pot\n    material: clay\n" +
         "    shape: " + shape + "\n";
}

Scene read(const std::string& text) { return read_scene(text, "test.yaml"); }

const std::string kBall = "sphere: {center: [0, 0, 0], radius: 2}";
const std::string kBore = "box: {lower: [-1, -1, 1], upper: [1, 1, 3]}";
const std::string kPot = clay("{difference: [{" + kBall + "}, {" + kBore + ", material: glaze}]}");

/// The object that a ray from there downwards meets first, and the normal.
std::pair<std::string, Vec3> below(const Scene& scene, const Vec3& eye) {
  std::pair<std::string, Vec3> found;
  double nearest = std::numeric_limits<double>::infinity();
  for (const Object& object : scene.objects) {
    Hits hits;
    object.shape->intersect({eye, {0, 0, -1}}, hits);
    for (const Hit& hit : hits) {
      if (hit.t <= 0 || hit.t >= nearest) continue;
      nearest = hit.t;
      found = {scene.material_of(static_cast<std::uint32_t>(&object - scene.objects.data())).name,
               hit.normal};
    }
  }
  return found;
}

TEST(Finish, WhatIsTakenAwayShowsItsOwn) {
  const Scene scene = read(kPot);
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "pot");
  EXPECT_EQ(scene.objects[1].name, "pot, part 2");
  const auto [floor, up] = below(scene, {0.2, 0.3, 5});
  EXPECT_EQ(floor, "glaze");
  expect_near(up, {0, 0, 1});
  EXPECT_EQ(below(scene, {1.5, 0, 5}).first, "clay");
  for (const Object& object : scene.objects) {
    EXPECT_EQ(object.sides, Sides::front);
    EXPECT_TRUE(object.shape->solid());
    EXPECT_TRUE(object.shape->contains({0, 0, 0}));
    EXPECT_FALSE(object.shape->contains({0, 0, 1.5}));
  }
}

TEST(Finish, ThePartsTogetherAreTheWhole) {
  const Scene parts = read(kPot);
  const Scene whole = read(clay("{difference: [{" + kBall + "}, {" + kBore + "}]}"));
  ASSERT_EQ(whole.objects.size(), 1u);
  for (int i = 0; i < 400; ++i) {
    const Ray ray{{0.2 * (i % 20) - 2, 0.2 * (i / 20) - 2, 5}, {0.1, -0.05, -1}};
    Hits expected, found;
    whole.objects[0].shape->intersect(ray, expected);
    for (const Object& part : parts.objects) part.shape->intersect(ray, found);
    std::sort(found.begin(), found.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].point, expected[k].point);
  }
}

TEST(Finish, AnInnerOneGoesBeforeAnOuterOne) {
  const Scene scene = read(
      clay("{union: [{union: [{sphere: {center: [0, 0, 0], radius: 1}}, {sphere: {center: [1, 0, "
           "0], radius: 1}, material: lamp, emission: {exitance: 7}}], material: glaze}, {sphere: "
           "{center: [2, 0, 0], radius: 1}}]}"));
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(below(scene, {-0.5, 0, 5}).first, "glaze");
  EXPECT_EQ(below(scene, {1, 0, 5}).first, "lamp");
  EXPECT_EQ(below(scene, {2.5, 0, 5}).first, "clay");
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scene.objects[i].exitance, gray(scene.material_of(i).name == "lamp" ? 7 : 0));
  }
}

TEST(Finish, AllAlikeIsOneObject) {
  const Scene scene =
      read(clay("{union: [{" + kBall + ", material: glaze}, {" + kBore + ", material: glaze}]}"));
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.material_of(0).name, "glaze");
}

TEST(Finish, IsWrittenWhereItIs) {
  const std::string named = "shapes: {pair: {union: [{" + kBall + "}, {" + kBore + "}]}}\n";
  const std::string shape =
      "{complement: {intersection: [{instance: pair, material: glaze}, {instance: pair, transform: "
      "[{translate: [1, 0, 0]}]}, {" +
      kBall + ", material: lamp, emission: {exitance: 5}}]}}";
  for (const std::string& text : {kPot, clay(shape, named)}) {
    const Scene scene = read(text);
    const std::string written = write_scene(scene);
    EXPECT_THAT(written, HasSubstr("material: glaze"));
    const Scene back = read(written);
    EXPECT_EQ(write_scene(back), written);
    ASSERT_EQ(back.objects.size(), scene.objects.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      EXPECT_EQ(back.objects[i].name, scene.objects[i].name);
      EXPECT_EQ(back.objects[i].material, scene.objects[i].material);
      EXPECT_EQ(back.objects[i].exitance, scene.objects[i].exitance);
      Hits here, there;
      scene.objects[i].shape->intersect({{0.2, 0.3, 9}, {0.01, 0, -1}}, here);
      back.objects[i].shape->intersect({{0.2, 0.3, 9}, {0.01, 0, -1}}, there);
      ASSERT_EQ(here.size(), there.size());
      for (std::size_t k = 0; k < here.size(); ++k) EXPECT_EQ(here[k].point, there[k].point);
    }
  }
}

TEST(Finish, ObjectsOfOneShapeInOnePlaceStayTwo) {
  Scene scene = read(kPot);
  const Scene twin = scene;
  scene.objects.insert(scene.objects.end(), twin.objects.begin(), twin.objects.end());
  EXPECT_EQ(read(write_scene(scene)).objects.size(), 4u);
}

TEST(Finish, ErrorsNameTheirPlace) {
  const std::string ball = "{" + kBall + ", material: glaze}";
  EXPECT_THAT(refusal(clay(ball)), EndsWith("give it to the object: only what shapes are made of "
                                            "has its own"));
  EXPECT_THAT(refusal(clay("{instance: ball}", "shapes: {ball: " + ball + "}\n")),
              EndsWith("a shape under 'shapes' looks as the objects say that it is in"));
  EXPECT_THAT(refusal(clay("{complement: {" + kBall + ", emission: {exitance: 5}}}")),
              EndsWith("a part that shines needs a 'material' of its own"));
  EXPECT_THAT(refusal(clay("{complement: {" + kBall + ", material: lamp, emission: {flux: 5}}}")),
              HasSubstr("'flux' needs a surface with an area"));
  EXPECT_THAT(refusal(clay("{complement: {" + kBall + ", material: glace}}")),
              EndsWith("6:76: unknown material 'glace': did you mean 'glaze'?"));
}

TEST(Finish, AHundredLooksAreTheMost) {
  std::string materials = "isolux: 1\nmaterials:\n", balls;
  for (int i = 0; i <= 100; ++i) {
    materials += fmt::format("  m{}: {{reflectance: 0.5}}\n", i);
    balls += fmt::format(", {{sphere: {{center: [{}, 0, 0], radius: 1}}, material: m{}}}", i, i);
  }
  const auto text = [&](const std::string& list) {
    return materials + "objects:\n  - material: m0\n    shape: {union: [" + list.substr(2) + "]}\n";
  };
  EXPECT_THAT(refusal(text(balls)), HasSubstr("look different in more than 100 ways"));
  EXPECT_EQ(read(text(balls.substr(0, balls.rfind(", {sphere")))).objects.size(), 100u);
}

}  // namespace
}  // namespace isolux
