#include "isolux/core/affine.h"

#include <gmock/gmock.h>

#include "scene/scene_text.h"

namespace isolux {
namespace {

/// Where the small ball that starts at (1, 0, 0) ends up.
Vec3 moved(const std::string& transform, const std::string& top = "") {
  return read_object("    shape: {sphere: {center: [1 m, 0, 0], radius: 1 mm}}\n    transform: " +
                         transform + "\n",
                     top)
      .shape->bounds()
      .center();
}

TEST(Transform, StepsApplyInTheOrderOfTheList) {
  expect_near(moved("[{rotate: {axis: z, angle: 90}}, {translate: [5, 0, 0]}]"), {5, 1, 0}, 1e-9);
  expect_near(moved("[{translate: [5, 0, 0]}, {rotate: {axis: z, angle: 90}}]"), {0, 6, 0}, 1e-9);
  expect_near(moved("[{scale: 2}, {scale: [1, 1, 3]}, {translate: [0, 0, 1]}]"), {2, 0, 1}, 1e-9);
}

TEST(Transform, RotationIsRightHandedInDegrees) {
  expect_near(moved("[{rotate: {axis: [0, 0, 2], angle: 450}}]"), {0, 1, 0}, 1e-9);
  expect_near(moved("[{rotate: {axis: -y, angle: 90}}]"), {0, 0, 1}, 1e-9);
}

TEST(Transform, MatrixHasItsTranslationAsLastColumnInLengths) {
  expect_near(moved("[{matrix: [[0, -1, 0, 3], [1, 0, 0, 4 cm], [0, 0, 1, 5]]}]", "unit: mm\n"),
              {0.003, 1.04, 0.005}, 1e-9);
}

TEST(Transform, InnerBeforeOuter) {
  const Object object = read_object(
      "    shape:\n"
      "      sphere: {center: [1, 0, 0], radius: 1 mm}\n"
      "      transform: [{translate: [1, 0, 0]}]\n"
      "    transform: [{rotate: {axis: z, angle: 90}}]\n");
  expect_near(object.shape->bounds().center(), {0, 2, 0}, 1e-9);
}

TEST(Transform, CollapsingChainIsRefused) {
  std::string steps;
  for (int i = 0; i < 200; ++i) steps += "{scale: 1e-6}, ";
  EXPECT_THAT(refusal(scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n"
                                 "    transform: [" +
                                 steps + "{scale: 1}]\n")),
              testing::HasSubstr("test.yaml:6:"));
}

}  // namespace
}  // namespace isolux
