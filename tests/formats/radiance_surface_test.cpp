#include <gmock/gmock.h>

#include <numbers>

#include "formats/radiance_text.h"
#include "isolux/formats/radiance/write_radiance.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/triangle_mesh.h"
#include "isolux/scene/writer.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

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
                         "void glow sky\n0\n0\n4 1 1 1 0\nsky source sky\n0\n0\n4 0 0 1 180\n"
                         "m mesh ship\n1 ship.rtm\n0\n0\nm instance tree\n1 tree.oct\n0\n0\n"
                         "m sphere s\n0\n0\n4 0 0 0 1\n");
  EXPECT_EQ(file.scene.objects.size(), 1u);
  EXPECT_TRUE(file.scene.sources.empty());
  EXPECT_THAT(file.notes,
              ElementsAre(HasSubstr("'source' left out: wider than"), HasSubstr("'mesh' left out"),
                          HasSubstr("'instance' left out")));
}

// Native → Radiance → native: what Radiance can express comes back as it was.

/// A scene with every kind of surface that Radiance has, in several materials, and lights.
Scene varied_scene() {
  const auto turned = [](std::shared_ptr<const Shape> shape) {
    return std::make_shared<Reversed>(std::move(shape));
  };
  const Vec3 a{0.1, 0.2, 0.3}, b{1.1, -0.4, 2.3};
  const std::vector<std::shared_ptr<const Shape>> shapes{
      std::make_shared<Sphere>(a, 0.7),
      turned(std::make_shared<Sphere>(a, 0.7)),
      std::make_shared<Cylinder>(a, b, 0.3, false),
      turned(std::make_shared<Cylinder>(a, b, 0.3, false)),
      std::make_shared<Frustum>(a, b, 0.3, 0.1, false),
      turned(std::make_shared<Frustum>(a, b, 0.3, 0, false)),
      std::make_shared<Disk>(a, b, 0.4, 0.1),
      std::make_shared<Disk>(a, b, 1.0 / 3),
      std::make_shared<Parallelogram>(a, Vec3{1, 0, 1}, Vec3{0, 3, 1}),
      std::make_shared<Polygon>(
          std::vector<Vec3>{{0, 0, 1}, {3, 0, 1}, {3, 1, 1}, {1, 1, 1}, {0, 4, 1}}),
      std::make_shared<TriangleMesh>(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                     std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}),
  };
  Scene scene;
  scene.materials = {{"grey", gray(1.0 / 3)}, {"red", {0.7, 0.1, 0.05}}, {"black", {}}};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Sides sides = shapes[i]->solid() ? Sides::front : Sides::both;
    const auto number = std::to_string(i);
    scene.objects.push_back(
        {"s" + number, shapes[i], static_cast<std::uint32_t>(i % 2), sides, {}});
    scene.objects.push_back({"lamp" + number, shapes[i], 2, Sides::front, {900, 700, 100.0 / 3}});
  }
  return scene;
}

TEST(RadianceSurface, WhatIsWrittenIsReadBack) {
  const Scene before = varied_scene();
  const WrittenScene written = write_radiance(before);
  EXPECT_THAT(written.notes, IsEmpty());
  const SceneFile file = read_radiance_text(written.text);
  EXPECT_THAT(file.notes, IsEmpty());
  const Scene& after = file.scene;
  ASSERT_EQ(after.objects.size(), before.objects.size());
  for (std::size_t i = 0; i < before.objects.size(); ++i) {
    const Object &x = before.objects[i], &y = after.objects[i];
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.sides, y.sides) << x.name;
    // A mesh of one triangle comes back as a polygon; all else is of its own kind.
    if (x.shape->describe().kind != "mesh") {
      EXPECT_EQ(x.shape->describe().kind, y.shape->describe().kind);
    }
    expect_near(x.shape->bounds().lower, y.shape->bounds().lower, 1e-9);
    expect_near(x.shape->bounds().upper, y.shape->bounds().upper, 1e-9);
    EXPECT_NEAR(surface_area(*x.shape).value(), surface_area(*y.shape).value(), 1e-9);
    Hits there, here;
    for (const Vec3& d : {Vec3{1, 0.2, 0.1}, Vec3{0, 0.1, 1}, Vec3{-0.3, 1, 0.2}}) {
      x.shape->intersect({{0.2, 0.1, 0.4}, d}, there);
      y.shape->intersect({{0.2, 0.1, 0.4}, d}, here);
    }
    ASSERT_EQ(there.size(), here.size());
    for (std::size_t k = 0; k < here.size(); ++k) {
      expect_near(there[k].normal, here[k].normal, 1e-9);
    }
    const Rgb r0 = before.material_of(static_cast<std::uint32_t>(i)).reflectance;
    const Rgb r1 = after.material_of(static_cast<std::uint32_t>(i)).reflectance;
    EXPECT_EQ(r0, r1) << x.name;
    EXPECT_NEAR(x.exitance.r, y.exitance.r, 1e-9 * x.exitance.r);
    EXPECT_NEAR(x.exitance.g, y.exitance.g, 1e-9 * x.exitance.g);
    EXPECT_NEAR(x.exitance.b, y.exitance.b, 1e-9 * x.exitance.b);
    EXPECT_NEAR(luminous_flux(x), luminous_flux(y), 1e-9 * luminous_flux(x));
  }
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
