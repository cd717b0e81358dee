#include <fmt/format.h>
#include <gmock/gmock.h>

#include "isolux/geometry/box.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/triangle_mesh.h"
#include "isolux/scene/check.h"
#include "isolux/scene/writer.h"
#include "scene_text.h"

namespace isolux {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ShapePtr = std::shared_ptr<const Shape>;

/// A pyramid cut into n triangles, wound outwards.
ShapePtr cone_of(std::uint32_t n) {
  std::vector<Vec3> points{{0, 0, 0}, {0, 0, 1}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double turn = 6.283185307179586 * i / n;
    points.push_back({std::cos(turn), std::sin(turn), 0});
    triangles.push_back({0, 2 + (i + 1) % n, 2 + i});
    triangles.push_back({1, 2 + i, 2 + (i + 1) % n});
  }
  return std::make_shared<TriangleMesh>(points, triangles);
}

ShapePtr moved(ShapePtr shape, double x) {
  return std::make_shared<Instance>(std::move(shape), Affine::translate({x, 0, 0}));
}

Scene scene_with(const std::vector<ShapePtr>& shapes) {
  Scene scene;
  scene.materials = {{"gray", gray(0.5)}};
  for (const ShapePtr& shape : shapes) {
    scene.objects.push_back({"thing", shape, 0, shape->solid() ? Sides::front : Sides::both, {}});
  }
  return scene;
}

const Shape* original_of(const Scene& scene, std::size_t object) {
  return original(scene.objects[object].shape).shape.get();
}

TEST(SharedShapes, AreOneInMemoryWhenReadBack) {
  const ShapePtr mesh = cone_of(40);
  const ShapePtr bent = std::make_shared<Instance>(mesh, Affine::scale({1, 2, -3}));
  const Scene scene = scene_with({mesh, moved(mesh, 1), moved(bent, 2), moved(cone_of(40), 3)});
  const std::string text = write_scene(scene);
  const Scene back = read_scene(text, "a.yaml");
  EXPECT_EQ(original_of(back, 0), original_of(back, 1));
  EXPECT_EQ(original_of(back, 0), original_of(back, 2));
  EXPECT_NE(original_of(back, 0), original_of(back, 3));
  EXPECT_EQ(write_scene(back), text);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    Hits there, here;
    scene.objects[i].shape->intersect({{0.1 + double(i), 0.2, 5}, {0.01, 0.02, -1}}, there);
    back.objects[i].shape->intersect({{0.1 + double(i), 0.2, 5}, {0.01, 0.02, -1}}, here);
    ASSERT_EQ(there.size(), 2u);
    ASSERT_EQ(here.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(there[k].point, here[k].point);
  }
}

TEST(SharedShapes, AreWrittenOnceHoweverManyTheirPlaces) {
  const auto size = [](std::uint32_t triangles, int places) {
    const ShapePtr mesh = cone_of(triangles);
    std::vector<ShapePtr> shapes;
    for (int i = 0; i < places; ++i) shapes.push_back(moved(mesh, 100 + i));
    return write_scene(scene_with(shapes)).size();
  };
  // An object of its own takes the same room whatever stands there.
  EXPECT_EQ(size(300, 200) - size(300, 100), size(30, 200) - size(30, 100));
  EXPECT_LT((size(300, 200) - size(300, 100)) / 100, 150u);
}

TEST(SharedShapes, MayBeMadeOfOthers) {
  const ShapePtr mesh = cone_of(12);
  const ShapePtr pair = std::make_shared<Csg>(CsgOperation::unite, mesh, moved(mesh, 0.5));
  const ShapePtr bored =
      std::make_shared<Csg>(CsgOperation::subtract, pair, std::make_shared<Sphere>(Vec3{}, 0.2));
  const Scene scene = scene_with({bored, moved(bored, 3), pair, std::make_shared<Reversed>(mesh)});
  const std::string text = write_scene(scene);
  EXPECT_THAT(text, HasSubstr("  union 2: {union: [{instance: mesh 1}, {instance: mesh 1, "
                              "transform: [{translate: [0.5, 0, 0]}]}]}\n"));
  EXPECT_THAT(text, HasSubstr("  difference 3: {difference: [{instance: union 2}, {sphere: "));
  EXPECT_THAT(text, HasSubstr("    shape: {reversed: {instance: mesh 1}}\n"));
  EXPECT_EQ(write_scene(read_scene(text, "a.yaml")), text);
  EXPECT_THAT(check_scene(scene).primitives, ElementsAre(Pair("mesh", 7), Pair("sphere", 2)));
}

TEST(SharedShapes, WhatIsSmallIsWrittenOut) {
  const ShapePtr ball = std::make_shared<Sphere>(Vec3{}, 1);
  EXPECT_THAT(write_scene(scene_with({ball, moved(ball, 2)})),
              HasSubstr("    shape: {sphere: {center: [0, 0, 0], radius: 1}, transform: "
                        "[{translate: [2, 0, 0]}]}\n"));
}

TEST(SharedShapes, AreKnownByNamesThatStandAbove) {
  const std::string ball = "    shape: {instance: ball}\n";
  const Object object =
      read_object(ball, "shapes: {ball: {sphere: {center: [1, 2, 3], radius: 2}}}\n");
  EXPECT_EQ(object.name, "instance 1");
  EXPECT_EQ(object.shape->bounds().upper, (Vec3{3, 4, 5}));
  EXPECT_EQ(refusal(scene_text(ball)),
            "test.yaml:5:23: no shape above is named 'ball': there are none");
  EXPECT_EQ(refusal(scene_text(ball, "shapes: {bell: {sphere: {center: [0, 0, 0], radius: 1}}}\n")),
            "test.yaml:6:23: no shape above is named 'ball': did you mean 'bell'?");
  // No shape can hold itself.
  EXPECT_EQ(refusal(scene_text(ball, "shapes: {ball: {reversed: {instance: ball}}}\n")),
            "test.yaml:2:38: no shape above is named 'ball': there are none");
}

TEST(SharedShapes, CantGrowBeyondMeasure) {
  const std::string unit = "  s0: {sphere: {center: [0, 0, 0], radius: 1}}\n";
  std::string doubled = "shapes:\n" + unit, chain = doubled;
  for (int i = 1; i <= 40; ++i) {
    doubled +=
        fmt::format("  s{0}: {{union: [{{instance: s{1}}}, {{instance: s{1}}}]}}\n", i, i - 1);
  }
  EXPECT_THAT(refusal(scene_text("    shape: {instance: s40}\n", doubled)),
              HasSubstr("more than 100000 shapes within one: make several objects"));
  for (int i = 1; i <= 200; ++i) {
    chain += fmt::format("  s{}: {{complement: {{instance: s{}}}}}\n", i, i - 1);
  }
  EXPECT_THAT(refusal(scene_text("    shape: {instance: s200}\n", chain)),
              HasSubstr("shapes nested more than 100 deep"));
}

TEST(SharedShapes, AreNoDeeperForTheirNames) {
  ShapePtr deep = cone_of(12), half;
  for (int i = 0; i < 99; ++i) {
    deep = std::make_shared<Reversed>(deep);
    if (i == 50) half = deep;
  }
  const std::string text = write_scene(scene_with({deep, moved(deep, 1), half}));
  EXPECT_EQ(write_scene(read_scene(text, "a.yaml")), text);
}

}  // namespace
}  // namespace isolux
