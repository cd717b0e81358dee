#include <gmock/gmock.h>

#include <numbers>

#include "formats/radiance_text.h"
#include "isolux/formats/radiance/write_radiance.h"
#include "isolux/geometry/box.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;

/// The only object of a primitive with that type and those numbers.
Object surface(const std::string& type, const std::string& numbers) {
  const auto objects = gray_objects("m " + type + " thing\n0\n0\n" + numbers + "\n");
  EXPECT_EQ(objects.size(), 1u);
  return objects.at(0);
}

double area(const Object& object) { return surface_area(*object.shape).value(); }

TEST(RadianceSurface, RoundOnesAreExact) {
  const Object ball = surface("sphere", "4 1 2 3 .5");
  EXPECT_TRUE(ball.shape->solid());
  EXPECT_EQ(ball.name, "thing");
  EXPECT_EQ(ball.sides, Sides::front);
  EXPECT_NEAR(area(ball), pi, 1e-12);
  EXPECT_NEAR(area(surface("cylinder", "7 0 0 0 0 0 2 .5")), 2 * pi, 1e-12);
  EXPECT_NEAR(area(surface("cone", "8 0 0 0 0 0 4 3 0")), 15 * pi, 1e-12);
  // Radiance takes the radii of a ring in any order.
  EXPECT_NEAR(area(surface("ring", "8 0 0 0 0 0 2 1 2")), 3 * pi, 1e-12);
  EXPECT_NEAR(area(surface("ring", "8 0 0 0 0 0 2 2 1")), 3 * pi, 1e-12);
  EXPECT_EQ(surface("cylinder", "7 0 0 0 0 0 2 .5").sides, Sides::both);
}

TEST(RadianceSurface, BubbleCupAndTubeFaceInward) {
  for (const auto& [type, numbers] : std::vector<std::pair<std::string, std::string>>{
           {"bubble", "4 0 0 0 1"},
           {"tube", "7 0 0 -1 0 0 1 1"},
           {"cup", "8 0 0 -1 0 0 1 1 2"},
           {"sphere", "4 0 0 0 -1"},  // a negative radius turns over too
           {"cylinder", "7 0 0 -1 0 0 1 -1"}}) {
    const Object object = surface(type, numbers);
    EXPECT_FALSE(object.shape->solid()) << type;
    EXPECT_EQ(object.sides, Sides::both) << type;
    const Hits hits = hits_along(*object.shape, {}, {1, 0, 0});
    ASSERT_EQ(hits.size(), 2u) << type;
    EXPECT_LT(hits[1].normal.x, 0) << type;
  }
  EXPECT_TRUE(surface("bubble", "4 0 0 0 -1").shape->solid());
  EXPECT_GT(hits_along(*surface("cone", "8 0 0 -1 0 0 1 1 2").shape, {}, {1, 0, 0})[1].normal.x, 0);
}

TEST(RadianceSurface, PolygonsMayHaveHolesBySeams) {
  const Object square = surface("polygon", "12 0 0 0 2 0 0 2 2 0 0 2 0");
  EXPECT_NEAR(area(square), 4, 1e-12);
  EXPECT_NEAR(hits_along(*square.shape, {0.5, 0.5, 1}, {0, 0, -1}).at(0).normal.z, 1, 1e-12);
  // A square with a square hole, the seam being there twice.
  const Object frame = surface("polygon",
                               "30 0 0 0 4 0 0 4 4 0 0 4 0 0 0 0 "
                               "1 1 0 1 3 0 3 3 0 3 1 0 1 1 0");
  EXPECT_NEAR(area(frame), 12, 1e-12);
  EXPECT_TRUE(hits_along(*frame.shape, {2, 2, 1}, {0, 0, -1}).empty());
  EXPECT_EQ(hits_along(*frame.shape, {0.5, 2, 1}, {0, 0, -1}).size(), 1u);
}

TEST(RadianceSurface, PolygonsOffTheirPlaneAreFolded) {
  const SceneFile file =
      read_radiance_text(kGray + "m polygon p\n0\n0\n12 0 0 0 1 0 0 1 1 .1 0 1 0\n");
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("cut into flat triangles")));
  EXPECT_GT(area(file.scene.objects[0]), 1);
}

TEST(RadianceSurface, WhatHasNoAreaIsLeftOut) {
  const SceneFile file = read_radiance_text(
      kGray + "m polygon p\n0\n0\n9 0 0 0 1 0 0 2 0 0\nm sphere s\n0\n0\n4 0 0 0 1\n");
  EXPECT_EQ(file.scene.objects.size(), 1u);
  EXPECT_THAT(file.notes, ElementsAre("surfaces without area: left out"));
}

TEST(RadianceSurface, SmallSourcesAreDirectionalLight) {
  // The sun: 0.533 degrees wide, straight above.
  const Scene scene =
      read_radiance_text(
          "void light sun\n0\n0\n3 1e6 1e6 1e6\nsun source sun\n0\n0\n4 0 0 2 .533\n"
          "sun sphere lamp\n0\n0\n4 0 0 0 1\n")
          .scene;
  ASSERT_EQ(scene.sources.size(), 1u);
  const Source& sun = scene.sources[0];
  EXPECT_EQ(sun.kind, Source::Kind::directional);
  EXPECT_EQ(sun.name, "sun");
  expect_near(sun.direction, {0, 0, -1});
  const double solid_angle = 2 * pi * (1 - std::cos(0.533 / 2 * pi / 180));
  EXPECT_NEAR(luminance(sun.intensity), 179e6 * solid_angle, 1);
}

TEST(RadianceSurface, WideSourcesMeshesAndInstancesAreNoted) {
  const SceneFile file =
      read_radiance_text(kGray +
                         "void glow sky\n0\n0\n4 1 1 1 0\nsky source sky\n0\n0\n4 0 0 1 90\n"
                         "m mesh ship\n1 ship.rtm\n0\n0\nm instance tree\n1 tree.oct\n0\n0\n"
                         "m sphere s\n0\n0\n4 0 0 0 1\n");
  EXPECT_EQ(file.scene.objects.size(), 1u);
  EXPECT_TRUE(file.scene.sources.empty());
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("'source' left out: wider than"),
                                      HasSubstr("'mesh' and 'instance' left out")));
}

TEST(RadianceSurface, ABoxComesBackAsItsSixFaces) {
  Scene scene;
  scene.materials = {{"grey", gray(0.5)}};
  scene.objects = {{"box", std::make_shared<Box>(Vec3{1, 1, 1}, Vec3{2, 3, 4}), 0, {}, {}}};
  const auto faces = read_radiance_text(write_radiance(scene).text).scene.objects;
  EXPECT_EQ(faces.size(), 6u);
  EXPECT_EQ(faces[1].name, "box 2");
  EXPECT_NEAR(volume_of(faces), 6, 1e-12);
}

}  // namespace
}  // namespace isolux
