#include <gmock/gmock.h>

#include <numbers>

#include "formats/radiance_text.h"
#include "formats/temporary_folder.h"

namespace isolux {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kBall = kGray + "m sphere ball\n0\n0\n4 0 0 0 1\n";

std::vector<std::string> camera_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) names.push_back(camera.name);
  return names;
}

std::string refusal(const TemporaryFolder& folder, const std::string& project) {
  try {
    read_radiance(folder.write("p.rif", project));
  } catch (const InputError& error) {
    return std::string(error.what()).substr(folder.path().string().size() + 1);
  }
  return {};
}

TEST(RadianceProject, NamesTheFilesAndViewsOfAScene) {
  const TemporaryFolder folder;
  folder.write("mats.rad", kGray);
  folder.write("parts/table", "!xform -t 5 0 0 parts/leg\n");
  folder.write("parts/leg", "m sphere leg\n0\n0\n4 0 0 0 1\n");
  folder.write("side.vf", "VIEW= -vtv -vp 9 9 9 -vd -1 -1 -1\n");
  const SceneFile file =
      read_radiance(folder.write("room.rif",
                                 "# a project,\n# 'tis said\n"
                                 "materials= mats.rad # first of all\n"
                                 "scene = parts/table \\\n"
                                 "  '!genbox m crate 1 1 1 | xform -t 9 0 0'\n"
                                 "objects= parts/leg\n"
                                 "UP= Y\n"
                                 "view= front -vp 1 2 3 -vd 0 0 -2 -vh 60 -vv 40\n"
                                 "VIEW=side -vf side.vf -vu 0 0 1\n"
                                 "QUALITY= Med\n"));
  EXPECT_THAT(file.notes, IsEmpty());
  EXPECT_EQ(file.scene.name, "room");
  EXPECT_EQ(file.scene.objects.size(), 7u);
  EXPECT_EQ(file.scene.objects[0].name, "leg");
  expect_near(file.scene.objects[0].shape->bounds().center(), {5, 0, 0});
  ASSERT_THAT(camera_names(file.scene), ElementsAre("front", "side"));
  const Camera& front = file.scene.cameras[0];
  expect_near(front.eye, {1, 2, 3});
  expect_near(front.look_at, {1, 2, 2});
  expect_near(front.up, {0, 1, 0});
  EXPECT_EQ(front.fov, 40);
  // The picture's shape is that of the tangents.
  EXPECT_EQ(front.height, std::lround(800 * std::tan(20 * std::numbers::pi / 180) /
                                      std::tan(30 * std::numbers::pi / 180)));
  expect_near(file.scene.cameras[1].eye, {9, 9, 9});
}

TEST(RadianceProject, WhatIsWrong) {
  const TemporaryFolder folder;
  folder.write("ball", kBall);
  EXPECT_EQ(refusal(folder, "scene= no-such\n"), "p.rif:1:8: there is no file 'no-such'");
  EXPECT_EQ(refusal(folder, "scene ball\n"), "p.rif:1:1: a line of a project is 'NAME= values'");
  EXPECT_EQ(refusal(folder, "scene= ball\nview= a -vp 1 2\n"), "p.rif:2:9: '-vp' needs 3 numbers");
  EXPECT_EQ(refusal(folder, "scene= ball\nview= a -vd 1 x 2\n"),
            "p.rif:2:15: expected a number, not 'x'");
  EXPECT_EQ(refusal(folder, "scene= '!genbox m b 1 1 x'\n"),
            "p.rif:1:25: expected a number, not 'x'");
  EXPECT_EQ(refusal(folder, "octree= a.oct\n"), "p.rif:1:1: the scene has no surfaces");
}

TEST(RadianceProject, ViewsThatAreNoPerspectivesAreLeftOut) {
  const TemporaryFolder folder;
  folder.write("ball", kBall);
  const SceneFile file = read_radiance(folder.write(
      "p.rif",
      "scene= ball\nview= plan -vtl -vd 0 0 -1 -vu 0 1 0\nview= top -vd 0 0 -1\nview= s -vs 1\n"));
  EXPECT_THAT(camera_names(file.scene), ElementsAre("default"));
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("views that are no plain perspectives")));
}

TEST(RadianceProject, ViewFilesBesideASceneAreItsCameras) {
  const TemporaryFolder folder;
  const auto scene = folder.write("ball.rad", kBall);
  EXPECT_THAT(camera_names(read_radiance(scene).scene), ElementsAre("default"));
  folder.write("above.vf", "rvu -vp 0 0 9 -vd 0 0 -1 -vu 0 1 0\n");
  folder.write("fish.vp", "rvu -vth -vp 0 0 9 -vd 0 0 -1 -vu 0 1 0 -vh 180 -vv 180\n");
  folder.write("bad.vp", "rvu -vp 0 x\n");
  const SceneFile others = read_radiance(scene);
  EXPECT_THAT(camera_names(others.scene), ElementsAre("default", "above"));
  // The last view of a file is the one that counts.
  folder.write("ball.vp", "rview -vp 1 0 0\nrpict -x 100 -vp 0 -9 0 -vh 30 -vv 30 -ab 2\n");
  const Scene own = read_radiance(scene).scene;
  EXPECT_THAT(camera_names(own), ElementsAre("ball", "above"));
  expect_near(own.cameras[0].eye, {0, -9, 0});
}

}  // namespace
}  // namespace isolux
