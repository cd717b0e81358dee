// What OpenSCAD's tree becomes: true solids where OpenSCAD itself has facets.
#include <gmock/gmock.h>

#include <numbers>

#include "formats/openscad_text.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

const std::string kFolder = ISOLUX_SOURCE_DIR "/tests/formats/openscad/";

std::string_view kind(const Shape& shape) { return shape.describe().kind; }

TEST(OpenScad, SolidsAreTrue) {
  struct Case {
    const char* text;
    std::string_view kind;
    double volume;  // m³
  };
  const double ring = 2 * pi * 3 * pi * 0.25;
  const Case cases[] = {
      {"cube(size = [1, 2, 3], center = true);", "box", 6},
      {"cube(size = 2, center = false);", "box", 8},
      {"sphere($fn = 0, $fa = 12, $fs = 2, r = 1);", "sphere", 4 * pi / 3},
      {"sphere($fn = 5, r = 1);", "sphere", 4 * pi / 3},
      {"cylinder($fn = 0, h = 2, r1 = 1, r2 = 1, center = true);", "cylinder", 2 * pi},
      {"cylinder($fn = 100, h = 3, r1 = 1, r2 = 0, center = true);", "cone", pi},
      {"cylinder($fn = 6, h = 2, r1 = 1, r2 = 1);", "prism", 3 * std::sqrt(3.0)},
      {"cylinder($fn = 4, h = 3, r1 = 0, r2 = 1);", "prism", 2},
      {"multmatrix([[0.866025, -0.5, 0, 1], [0.5, 0.866025, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]) {"
       " cylinder(h = 1, r1 = 1, r2 = 1); }",
       "cylinder", pi},
      {"multmatrix([[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) { sphere(r = 1); }",
       "sphere", 8 * pi / 3},
      {"linear_extrude(height = 2, center = true) { circle(r = 1); }", "cylinder", 2 * pi},
      {"linear_extrude(height = 3, scale = [0, 0]) { circle(r = 1); }", "cone", pi},
      {"linear_extrude(height = 2, twist = 90) { square(size = [1, 2], center = true); }", "prism",
       4},
      {"linear_extrude(height = 3, scale = 0.5) { multmatrix([[1, 0, 0, 5], [0, 1, 0, 0], "
       "[0, 0, 1, 0], [0, 0, 0, 1]]) { circle(r = 1); } }",
       "cone", 1.75 * pi},
      {"rotate_extrude() { multmatrix([[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {"
       " circle(r = 0.5); } }",
       "torus", ring},
      {"rotate_extrude(angle = -90) { multmatrix([[1, 0, 0, 3], [0, 1, 0, 0], [0, 0, 1, 0], "
       "[0, 0, 0, 1]]) { circle(r = 0.5); } }",
       "intersection", ring / 4},
      {"rotate_extrude() { polygon(points = [[0, 0], [1, 0], [1, 1], [0, 1]]); }", "revolution",
       pi},
      {"rotate_extrude() { polygon(points = [[0, 0], [-1, 0], [-1, 1], [0, 1]]); }", "revolution",
       pi},
      {"rotate_extrude() { difference() { circle(r = 1); multmatrix([[1, 0, 0, -5], [0, 1, 0, 0], "
       "[0, 0, 1, 0], [0, 0, 0, 1]]) { square(size = 10, center = true); } } }",
       "sphere", 4 * pi / 3},
      {"linear_extrude(height = 1) { polygon(points = [[0, 0], [4, 0], [0, 4], [1, 1], [2, 1], "
       "[1, 2]], paths = [[0, 1, 2], [3, 4, 5]]); }",
       "prism", 7.5},
      {"difference() { cube(size = 2, center = true); cylinder(h = 4, r1 = 0.5, r2 = 0.5, "
       "center = true); }",
       "difference", 8 - pi / 2},
      {"polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[0, 1, 2], "
       "[0, 3, 1], [0, 2, 3], [1, 3, 2]]);",
       "mesh", 1.0 / 6},
      {"polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[2, 1, 0], "
       "[1, 3, 0], [3, 2, 0], [2, 3, 1]]);",
       "mesh", 1.0 / 6},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const auto shape = model_shape(c.text);
    EXPECT_EQ(kind(*shape), c.kind);
    EXPECT_TRUE(shape->solid());
    EXPECT_FALSE(shape->unbounded());
    EXPECT_NEAR(volume_of(*shape), c.volume, 3e-3 * c.volume);
  }
}

TEST(OpenScad, AFlangeFromAFile) {
  const SceneFile file = load_scene_file(kFolder + "flange.csg");
  ASSERT_EQ(file.scene.objects.size(), 1u);
  const Shape& flange = *file.scene.objects[0].shape;
  const double cone = pi * 30 / 3 * (25 * 25 + 25 * 15 + 15 * 15);
  const double boss = 10 * 1.5 * std::sqrt(3.0) * 15 * 15;
  const double holes = pi * (50 * 8 * 8 + 6 * 10 * 4 * 4);
  const double volume = pi * 50 * 50 * 10 + cone + boss - holes;  // mm³
  EXPECT_NEAR(volume_of(flange), volume * 1e-9, 2e-3 * volume * 1e-9);
  EXPECT_NEAR(flange.bounds().upper.z, 0.05, 1e-12);
  EXPECT_EQ(file.notes.size(), 1u) << "there are no lights, but all else is kept";
  EXPECT_EQ(file.scene.cameras.size(), 1u);
}

TEST(OpenScad, VesselsFromAFile) {
  const Scene scene = load_scene_file(kFolder + "vessels.csg").scene;
  const double hollow = 2.0 / 3 * pi * (1000 - 512) * 2;
  const double expected[] = {7.0 / 12 * 20 * (200 - pi * 9), 3000, pi * pi / 2 * 20 * 25, hollow,
                             5 * (900 - 400 + 100)};
  const char* const colors[] = {"#ff0000", "#00ff00", "#0000ff", "#ffffff", "#808080"};
  ASSERT_EQ(scene.objects.size(), std::size(expected));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    SCOPED_TRACE(scene.objects[i].name);
    EXPECT_NEAR(volume_of(*scene.objects[i].shape) * 1e9, expected[i], 5e-3 * expected[i]);
    EXPECT_EQ(scene.material_of(static_cast<std::uint32_t>(i)).name, colors[i]);
  }
  EXPECT_NEAR(scene.material_of(4).reflectance.g, 0.2159, 1e-4);
  EXPECT_EQ(scene.material_of(3).reflectance, gray(0.9));
}

TEST(OpenScad, WhatIsNotKeptIsNamedOnce) {
  const SceneFile file = load_scene_file(kFolder + "die.csg");
  // The die, the wedge, two balls that a hull had wrapped, the cube of a Minkowski sum.
  ASSERT_EQ(file.scene.objects.size(), 5u);
  EXPECT_NEAR(volume_of(*file.scene.objects[1].shape) * 1e9, 500, 1);
  for (const char* note : {"'hull'", "'minkowski'", "flattens", "'text'", "nothing shines"}) {
    EXPECT_TRUE(has_note(file, note)) << note;
  }
  EXPECT_EQ(file.notes.size(), 5u);
}

TEST(OpenScad, ColorsAndLightsComeFromBeside) {
  const SceneFile file = read_model(
      "color([1, 0, 0, 1]) { cube(size = 1); color([0, 1, 0, 1]) { sphere(r = 1); } }\n"
      "color([0, 0, 1, 0.5]) { sphere(r = 2); }\n"
      "cube(size = 5);\n",
      "unit: cm\n"
      "materials:\n"
      "  brick: {color: \"#ff0000\", reflectance: 0.3}\n"
      "  lamp: {color: [0, 0, 1], reflectance: 0, emission: {flux: 100}}\n"
      "  rest: {reflectance: 0.7}\n"
      "lights:\n"
      "  - point: {position: [0, 0, 50], intensity: 10}\n"
      "cameras:\n"
      "  near: {eye: [100, 0, 0], look_at: [0, 0, 0]}\n");
  const Scene& scene = file.scene;
  ASSERT_EQ(scene.objects.size(), 4u);
  EXPECT_EQ(scene.material_of(0).name, "brick");
  EXPECT_EQ(scene.material_of(1).name, "brick") << "an outer color goes before an inner one";
  EXPECT_EQ(scene.material_of(2).name, "lamp");
  EXPECT_EQ(scene.material_of(3).reflectance, gray(0.7));
  EXPECT_NEAR(luminous_flux(scene.objects[2]), 100, 1e-9);
  EXPECT_NEAR(scene.objects[2].shape->bounds().upper.z, 0.02, 1e-15);
  ASSERT_EQ(scene.sources.size(), 1u);
  EXPECT_NEAR(scene.sources[0].position.z, 0.5, 1e-15);
  EXPECT_EQ(scene.camera("near").eye, (Vec3{1, 0, 0}));
  EXPECT_TRUE(has_note(file, "opacity"));
}

TEST(OpenScad, TheExampleIsLitByItsFlame) {
  const SceneFile file = load_scene_file(ISOLUX_SOURCE_DIR "/examples/openscad/candlestick.csg");
  EXPECT_THAT(file.notes, testing::IsEmpty());
  std::size_t flames = 0;
  for (const Object& object : file.scene.objects) flames += object.emits();
  EXPECT_EQ(flames, 1u);
}

TEST(OpenScad, EmptyOperandsAreAsInOpenScad) {
  const auto objects = [](const std::string& text) {
    return read_model(text + " cube(size = 1);").scene.objects.size();
  };
  EXPECT_EQ(objects("group();"), 1u);
  EXPECT_EQ(objects("difference() { group(); cube(size = 1); }"), 1u);
  EXPECT_EQ(objects("difference() { cube(size = 1); group(); }"), 2u);
  EXPECT_EQ(objects("intersection() { cube(size = 1); group(); }"), 1u);
  EXPECT_EQ(objects("intersection() { cube(size = 1); multmatrix([[1, 0, 0, 9], [0, 1, 0, 0], "
                    "[0, 0, 1, 0], [0, 0, 0, 1]]) { cube(size = 1); } }"),
            1u);
  EXPECT_EQ(objects("%sphere(r = 1); #sphere(r = 2);"), 2u);
  EXPECT_EQ(objects("square(size = 3); linear_extrude(height = 0) { square(size = 1); }"), 1u);
}

}  // namespace
}  // namespace isolux
