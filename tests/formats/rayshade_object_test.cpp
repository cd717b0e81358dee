// Primitives, surfaces, transforms, names and mentions.
#include <gtest/gtest.h>

#include <bit>
#include <numbers>
#include <set>

#include "formats/rayshade_text.h"

namespace isolux {
namespace {

using std::numbers::pi;

TEST(RayshadeObjects, EachPrimitiveIsTheOneThatWasMeant) {
  struct Case {
    const char* text;
    double area;
    bool solid;
    Vec3 lower, upper;
  };
  const Case cases[] = {
      {"sphere 2 1 2 3", 16 * pi, true, {-1, 0, 1}, {3, 4, 5}},
      {"box 1 2 3 0 0 0", 22, true, {0, 0, 0}, {1, 2, 3}},
      {"cylinder 1 0 0 1 0 0 3", 4 * pi, false, {-1, -1, 1}, {1, 1, 3}},
      {"cone 3 0 0 0 0 0 0 4", 15 * pi, false, {-3, -3, 0}, {3, 3, 4}},
      {"cone 1 0 0 1 1 0 0 3", 4 * pi, false, {-1, -1, 1}, {1, 1, 3}},
      {"disc 2 0 0 1 0 0 5", 4 * pi, false, {-2, -2, 1}, {2, 2, 1}},
      {"torus 2 1 0 0 0 0 3 0", 8 * pi * pi, true, {-3, -1, -3}, {3, 1, 3}},
      {"triangle 0 0 0 2 0 0 0 2 0", 2, false, {0, 0, 0}, {2, 2, 0}},
      {"triangle 0 0 0 0 0 1 2 0 0 0 0 1 0 2 0 0 0 1", 2, false, {0, 0, 0}, {2, 2, 0}},
      {"triangleuv 0 0 0 0 0 1 0 0 2 0 0 0 0 1 1 0 0 2 0 0 0 1 0 1",
       2,
       false,
       {0, 0, 0},
       {2, 2, 0}},
      {"poly 0 0 0 2 0 0 2 2 0 0 2 0", 4, false, {0, 0, 0}, {2, 2, 0}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const auto shape = rayshade_shape(c.text);
    EXPECT_NEAR(surface_area(*shape).value_or(0), c.area, 1e-9 * c.area);
    EXPECT_EQ(shape->solid(), c.solid);
    expect_near(shape->bounds().lower, c.lower, 1e-9);
    expect_near(shape->bounds().upper, c.upper, 1e-9);
  }
}

// Strength, then radius: 0.25 = 4 (1 − d²/2²)² at d = 2 √(3/4).
TEST(RayshadeObjects, Blob) {
  const auto blob = rayshade_shape("blob 0.25 4 2 1 0 0  1 1 9 0 0");
  EXPECT_TRUE(blob->solid());
  Hits hits;
  blob->intersect({{1, 0, -5}, {0, 0, 1}}, hits);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[1].point.z, 2 * std::sqrt(0.75), 1e-12);
}

TEST(RayshadeObjects, PlanesAreCutFarOut) {
  const SceneFile file = read_rayshade_text("plane 5 7 -1 0 0 2 sphere 1 0 0 0 eyep 0 -10 0");
  const Bounds box = file.scene.objects[0].shape->bounds();
  EXPECT_NEAR(box.lower.z, -1, 1e-12);
  EXPECT_NEAR(box.upper.z, -1, 1e-12);
  EXPECT_LT(box.lower.x, -20);
  EXPECT_GT(box.upper.y, 15);
  EXPECT_TRUE(has_note(file, "planes are cut"));
  // Whatever is around it: here a plane turned to look along x.
  const Scene turned = rayshade_scene(
      "name wall plane 0 0 2 0 0 1\nlist object wall rotate 0 1 0 90 end translate 1 0 0\n"
      "sphere 1 0 0 0");
  EXPECT_NEAR(turned.objects[0].shape->bounds().upper.x, 3, 1e-9);
  EXPECT_NEAR(turned.objects[0].shape->bounds().lower.x, 3, 1e-9);
}

TEST(RayshadeObjects, HeightField) {
  for (const bool big_end_first : {false, true}) {
    std::string bytes;
    const auto put = [&](std::uint32_t word) {
      for (int i = 0; i < 4; ++i) {
        bytes += static_cast<char>(word >> (8 * (big_end_first ? 3 - i : i)) & 0xff);
      }
    };
    put(3);
    for (const float height : {0.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, -1000.f}) {
      put(std::bit_cast<std::uint32_t>(height));
    }
    write_scene(bytes, "hills.hf");
    const auto field = rayshade_shape("surface grass diffuse .1 .6 .1 heightfield grass hills.hf");
    EXPECT_EQ(field->part_count(), 7u) << "of 8 triangles one has a corner that is not there";
    expect_near(field->bounds().lower, {0, 0, 0});
    expect_near(field->bounds().upper, {1, 1, 1});
    Hits hits;
    field->intersect({{0.375, 0.5, 5}, {0, 0, -1}}, hits);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_NEAR(hits[0].point.z, 0.75, 1e-6);
    EXPECT_GT(hits[0].normal.z, 0);
  }
}

TEST(RayshadeObjects, TrianglesInARowAreOneMesh) {
  const Scene scene = rayshade_scene(
      "surface red diffuse .5 0 0\n"
      "triangle 0 0 0 1 0 0 0 1 0\ntriangle 1 0 0 1 1 0 0 1 0\n"
      "triangle 0 0 0 0 0 0 0 1 0 /* no area */\n"
      "triangle red 0 0 1 1 0 1 0 1 1\n");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].shape->part_count(), 2u);
  EXPECT_EQ(scene.objects[1].shape->part_count(), 1u);
}

TEST(RayshadeObjects, SurfacesAreThoseOfRayshade) {
  const Scene scene = rayshade_scene(
      "surface red diffuse .5 .1 .1 specular 1 1 1\n"
      "sphere 1 0 0 0\n"                       // the default
      "sphere red 1 3 0 0\n"                   // named
      "sphere red diffuse .2 .2 .2 1 6 0 0\n"  // named, and changed
      "sphere diffuse .2 .2 .2 1 9 0 0\n"      // in place
      "applysurf red sphere 1 12 0 0\n"        // current
      "list sphere 1 15 0 0 applysurf diffuse .3 .3 .3 sphere 1 18 0 0\n"
      "  sphere cursurf ambient 1 1 1 1 21 0 0 end\n"
      "sphere 1 24 0 0\n"
      "surface dark sphere dark 1 27 0 0\n"
      "surface pale red diffuse 2 1 .5 sphere pale 1 30 0 0\n");
  const double expected[][3] = {{.6, .6, .6}, {.5, .1, .1}, {.2, .2, .2},    {.2, .2, .2},
                                {.5, .1, .1}, {.5, .1, .1}, {.3, .3, .3},    {.3, .3, .3},
                                {.5, .1, .1}, {0, 0, 0},    {.999, .999, .5}};
  for (std::size_t i = 0; i < std::size(expected); ++i) {
    const Rgb rho = scene.material_of(static_cast<std::uint32_t>(i)).reflectance;
    EXPECT_EQ(rho, (Rgb{expected[i][0], expected[i][1], expected[i][2]})) << "object " << i + 1;
  }
  EXPECT_EQ(scene.objects[2].material, scene.objects[3].material);
  EXPECT_EQ(scene.objects[1].material, scene.objects[8].material);
  std::set<std::string> names;
  for (const Material& material : scene.materials) EXPECT_TRUE(names.insert(material.name).second);
  EXPECT_EQ(scene.materials.size(), 6u);
}

TEST(RayshadeObjects, AMentionsSurfaceIsForPartsThatHaveNone) {
  const Scene scene = rayshade_scene(
      "surface red diffuse .5 0 0 surface blue diffuse 0 0 .5\n"
      "name pair list sphere 1 0 0 0 sphere red 1 3 0 0 end\n"
      "object blue pair object pair translate 0 5 0\n"
      "object blue diffuse .1 .1 .1 pair translate 0 10 0\n");
  const double red[] = {0, .5, .6, .5, .1, .5};
  for (std::uint32_t i = 0; i < 6; ++i) {
    EXPECT_EQ(scene.material_of(i).reflectance.r, red[i]) << "object " << i + 1;
  }
}

TEST(RayshadeObjects, TransformsInTheirOrder) {
  const auto middle = [](const std::string& transforms) {
    return rayshade_shape("sphere 1 1 0 0 " + transforms)->bounds().center();
  };
  expect_near(middle("translate 1 2 3 scale 2 3 4"), {4, 6, 12}, 1e-12);
  expect_near(middle("scale 2 3 4 translate 1 2 3"), {3, 2, 3}, 1e-12);
  expect_near(middle("rotate 0 0 1 90 translate 1 0 0"), {1, 1, 0}, 1e-12);
  expect_near(middle("translate 1 0 0 rotate 0 0 1 90"), {0, 2, 0}, 1e-12);
  // Rows for points that stand before the matrix: x goes to the first row.
  expect_near(middle("transform 0 1 0 -1 0 0 0 0 1"), {0, 1, 0}, 1e-12);
  expect_near(middle("transform 1 2 0 0 1 0 0 0 1 5 6 7"), {6, 8, 7}, 1e-12);
  const Scene nested = rayshade_scene(
      "list list sphere 1 1 0 0 translate 1 0 0 end scale 2 2 2 end rotate 0 0 1 90");
  expect_near(nested.objects[0].shape->bounds().center(), {0, 4, 0}, 1e-12);
  EXPECT_NEAR(*nested.objects[0].shape->area(), 16 * pi, 1e-9);
}

TEST(RayshadeObjects, MentionsAndNames) {
  const Scene scene = rayshade_scene(
      "name leg cylinder .1 0 0 0 0 0 1\n"
      "name table list object leg object leg translate 1 0 0 box 0 0 1 1 1 1.1 end\n"
      "object table object table translate 5 0 0\n"
      "name ball sphere 1 0 0 9 object ball object ball translate 3 0 0 sphere 1 0 0 20\n");
  std::vector<std::string> names;
  for (const Object& object : scene.objects) names.push_back(object.name);
  const std::vector<std::string> expected = {
      "leg", "leg 2", "table box 3", "leg 3", "leg 4", "table box 6", "ball", "ball 2", "sphere 9"};
  EXPECT_EQ(names, expected);
  expect_near(scene.objects[4].shape->bounds().center(), {6, 0, 0.5}, 1e-12);
}

TEST(RayshadeObjects, ManyMentionsShareOneShape) {
  std::string text =
      "name part difference box 0 0 0 1 1 1 sphere .5 0 0 0 end\n"
      "name ten list\n";
  for (int i = 0; i < 10; ++i) text += "object part translate " + std::to_string(2 * i) + " 0 0\n";
  text += "end\nname hundred list\n";
  for (int i = 0; i < 10; ++i) text += "object ten translate 0 " + std::to_string(2 * i) + " 0\n";
  text += "end\n";
  for (int i = 0; i < 10; ++i)
    text += "object hundred translate 0 0 " + std::to_string(2 * i) + "\n";
  const Scene scene = rayshade_scene(text);
  EXPECT_EQ(scene.objects.size(), 1000u);
  EXPECT_TRUE(scene.objects[999].shape->contains({18.9, 18.9, 18.9}));
  EXPECT_FALSE(scene.objects[999].shape->contains({18.1, 18.1, 18.1}));
}

TEST(RayshadeObjects, WhatIsClosedAroundTheEyeIsARoom) {
  const SceneFile file = read_rayshade_text("box -9 -9 -9 9 9 9 sphere 1 0 0 0 eyep 0 -5 0");
  EXPECT_TRUE(file.scene.objects[0].shape->unbounded());
  EXPECT_FALSE(file.scene.objects[1].shape->unbounded());
  EXPECT_TRUE(has_note(file, "seen from inside"));
  // A tetrahedron wound inside out looks out all the same.
  const auto mesh = rayshade_shape(
      "list triangle 0 0 0 1 0 0 0 1 0 triangle 0 0 0 0 0 1 1 0 0\n"
      "triangle 0 0 0 0 1 0 0 0 1 triangle 1 0 0 0 0 1 0 1 0 end");
  ASSERT_TRUE(mesh->solid());
  EXPECT_FALSE(mesh->unbounded());
  EXPECT_TRUE(mesh->contains({0.1, 0.1, 0.1}));
}

}  // namespace
}  // namespace isolux
