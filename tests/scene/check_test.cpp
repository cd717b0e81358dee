#include "isolux/scene/check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "scene/scene_text.h"

namespace isolux {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::Pair;

SceneReport check(const std::string& text) { return check_scene(read_scene(text, "test.yaml")); }

TEST(Check, TheRoomOfThePaperIsWithoutDoubt) {
  const SceneReport report =
      check_scene(load_scene(ISOLUX_SOURCE_DIR "/examples/lalonde1993/room.yaml"));
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_EQ(report.lights, 1u);
  EXPECT_NEAR(report.flux, 500, 1e-6);
  EXPECT_EQ(report.unit, "m");
  ASSERT_EQ(report.objects.size(), 4u);
  EXPECT_EQ(report.objects[0].material, "plaster");
  EXPECT_NEAR(report.objects[0].area.value(), 6, 1e-12);
  EXPECT_NEAR(report.objects[3].flux, 500, 1e-6);
}

TEST(Check, TheDieIsWithoutDoubt) {
  const SceneReport report = check_scene(load_scene(ISOLUX_SOURCE_DIR "/examples/csg/die.yaml"));
  EXPECT_THAT(report.warnings, IsEmpty());
  EXPECT_EQ(report.unit, "cm");
}

TEST(Check, DoubtfulThingsAreNamed) {
  const SceneReport report = check(
      "isolux: 1\n"
      "materials: {snow: {reflectance: 0.97}, spare: {reflectance: 0.5}}\n"
      "objects:\n"
      "  - {name: a, material: snow, shape: {sphere: {center: [0, 0, 0], radius: 1}}}\n"
      "  - {name: a, material: snow, shape: {sphere: {center: [2, 0, 0], radius: 1}}}\n"
      "  - {name: a, material: snow, shape: {sphere: {center: [20 km, 0, 0], radius: 1}}}\n"
      "  - name: lamp\n"
      "    material: snow\n"
      "    shape: {disk: {center: [0, 0, 3], normal: -z, radius: 1 mm}}\n"
      "    emission: {flux: 10}\n");
  EXPECT_THAT(report.warnings, Contains(HasSubstr("no camera")));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("'spare' is not used")));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("'snow' reflects 0.97")));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("several objects are named 'a'")));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("'lamp' also reflects")));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("'lamp' is tiny")));
  EXPECT_THAT(report.warnings, Contains(HasSubstr("far larger or farther")));
  EXPECT_EQ(report.warnings.size(), 7u);
}

TEST(Check, OfManyAlikeThreeAreNamed) {
  std::string text = "isolux: 1\nmaterials: {m: {reflectance: 0.5}}\nobjects:\n";
  for (int i = 0; i < 12; ++i) {
    for (int twin = 0; twin < 2; ++twin) {
      text += fmt::format(
          "  - {{name: s{}, material: m, shape: {{sphere: {{center: [{}, 0, 0], radius: 1}}}}}}\n",
          i, 3 * i);
    }
  }
  const SceneReport report = check(text);
  EXPECT_THAT(report.warnings, Contains("several objects are named 's2'"));
  EXPECT_THAT(report.warnings, Not(Contains("several objects are named 's3'")));
  EXPECT_THAT(report.warnings, Contains("and 9 more like that"));
}

TEST(Check, PrimitivesAreCountedWithinSolidsAndMaps) {
  const SceneReport report = check(R"(isolux: 1
materials: {m: {reflectance: 0.5}}
objects:
  - shape:
      difference:
        - box: {lower: [0, 0, 0], upper: [1, 1, 1]}
        - union:
            - sphere: {center: [0, 0, 0], radius: 0.3}
            - sphere: {center: [1, 0, 0], radius: 0.3}
    material: m
  - {shape: {box: {lower: [2, 0, 0], upper: [3, 1, 1]}}, transform: [{rotate: {axis: z, angle: 30}}], material: m}
)");
  EXPECT_THAT(report.primitives, ElementsAre(Pair("box", 2), Pair("sphere", 2)));
}

TEST(Check, DarknessIsNamed) {
  EXPECT_THAT(check(scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n")).warnings,
              Contains(HasSubstr("nothing gives light")));
}

TEST(Check, ASkyIsALight) {
  const std::string ball = scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n");
  EXPECT_FALSE(check(ball).sky);
  const SceneReport lit =
      check(ball +
            "sky: {type: clear, sun: [0, 1, 1], illuminance: 12000, color: [1, 2, 3], "
            "ground: 300}\n");
  EXPECT_THAT(lit.warnings, Not(Contains(HasSubstr("nothing gives light"))));
  EXPECT_EQ(lit.lights, 1u);
  EXPECT_EQ(lit.flux, 0);
  ASSERT_TRUE(lit.sky);
  EXPECT_NEAR(lit.sky->illuminance, 12000, 1e-8);
  EXPECT_NEAR(lit.sky->ground, 300, 1e-10);

  const SceneReport night = check(ball + "sky: {type: uniform, zenith: 0}\n");
  EXPECT_THAT(night.warnings, Contains(HasSubstr("nothing gives light")));
  EXPECT_EQ(night.lights, 0u);
}

}  // namespace
}  // namespace isolux
