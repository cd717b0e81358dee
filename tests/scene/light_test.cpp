#include <gmock/gmock.h>

#include <numbers>

#include "scene/scene_text.h"

namespace isolux {
namespace {

const std::string kPanel =
    "    shape: {parallelogram: {corner: [0, 0, 0], u: [2, 0, 0], v: [0, 25 cm, 0]}}\n";

TEST(Light, ExitanceIsTakenAsItIs) {
  EXPECT_EQ(read_object(kPanel + "    emission: {exitance: 100}\n").exitance, gray(100));
  EXPECT_EQ(read_object(kPanel + "    emission: {exitance: [1, 2, 3]}\n").exitance, (Rgb{1, 2, 3}));
  EXPECT_FALSE(read_object(kPanel).emits());
}

TEST(Light, FluxIsExitanceTimesArea) {
  const Object light = read_object(kPanel + "    emission: {flux: 1000}\n");
  EXPECT_NEAR(light.exitance.r, 2000, 1e-9);
  EXPECT_NEAR(luminous_flux(light), 1000, 1e-9);
}

TEST(Light, ColorChangesTheChannelsButNotTheFlux) {
  const Object light = read_object(kPanel + "    emission: {flux: 1000, color: [1, 0.5, 0.25]}\n");
  EXPECT_NEAR(light.exitance.g / light.exitance.r, 0.5, 1e-12);
  EXPECT_NEAR(light.exitance.b / light.exitance.r, 0.25, 1e-12);
  EXPECT_NEAR(luminous_flux(light), 1000, 1e-9);
}

TEST(Light, AreaIsThatOfTheTransformedShape) {
  const Object light =
      read_object(kPanel + "    transform: [{scale: [1, 4, 9]}]\n    emission: {flux: 1000}\n");
  EXPECT_NEAR(light.exitance.r, 500, 1e-9);
}

TEST(Light, ClosedShapesEmitAllAround) {
  const Object lamp = read_object(
      "    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n    emission: {flux: 100}\n");
  EXPECT_NEAR(lamp.exitance.r, 100 / (4 * std::numbers::pi), 1e-9);
}

// The list that the refusal of other shapes names.
TEST(Light, ShapesThatMayEmit) {
  for (const char* shape :
       {"sphere: {center: [0, 0, 0], radius: 1}",
        "cylinder: {from: [0, 0, 0], to: [0, 0, 1], radius: 1}",
        "cone: {from: [0, 0, 0], to: [0, 0, 1], radii: [1, 0]}",
        "disk: {center: [0, 0, 0], normal: z, radius: 1, inner_radius: 0.5}",
        "box: {lower: [0, 0, 0], upper: [1, 1, 1]}",
        "parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}",
        "polygon: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0]]}",
        "mesh: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], triangles: [[0, 1, 2]]}"}) {
    const Object light = read_object("    shape: {" + std::string(shape) +
                                     "}\n    emission: {flux: 100, color: [1, 2, 3]}\n");
    EXPECT_NEAR(luminous_flux(light), 100, 1e-6) << shape;
  }
}

TEST(Light, ColorBesideThreeChannelsIsRefused) {
  EXPECT_THAT(
      refusal(scene_text(kPanel + "    emission: {exitance: [1, 2, 3], color: [1, 1, 1]}\n")),
      testing::HasSubstr("remove 'color'"));
}

}  // namespace
}  // namespace isolux
