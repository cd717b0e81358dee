#include "isolux/formats/scene_file.h"

#include <gmock/gmock.h>

#include "formats/temporary_folder.h"
#include "isolux/core/error.h"

namespace isolux {
namespace {

const std::string kBall = "v a =\nsph a 1\n";

TEST(SceneFile, TheFormatIsThatOfTheExtensionOrAsAskedFor) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_scene_file(folder.write("ball.mgf", kBall)).scene.name, "ball");
  EXPECT_EQ(load_scene_file(folder.write("BALL.MGF", kBall)).scene.name, "BALL");
  EXPECT_EQ(load_scene_file(folder.write("ball.txt", kBall), "mgf").scene.name, "ball");
  const std::string ball = "void sphere s 0 0 4 0 0 0 1\na sphere s 0 0 4 0 0 0 1\n";
  EXPECT_EQ(load_scene_file(folder.write("round.rad", ball)).scene.name, "round");
  EXPECT_EQ(load_scene_file(folder.write("bare", ball), "radiance").scene.name, "bare");
  EXPECT_EQ(load_scene_file(folder.write("all.rif", "scene= bare\n")).scene.name, "all");
  EXPECT_THROW(load_scene_file(folder.path() / "ball.mgf", "isolux"), InputError);
  EXPECT_THROW(load_scene_file(folder.path() / "ball.mgf", "fgm"), InputError);
  EXPECT_THROW(load_scene_file(folder.path() / "missing.mgf"), InputError);
}

TEST(SceneFile, FormatsHaveNames) {
  EXPECT_THAT(format_names(), testing::IsSupersetOf({"isolux", "mgf", "radiance", "rayshade"}));
}

TEST(SceneFile, ReadingTellsHowFarItIsAndCanBeStopped) {
  const TemporaryFolder folder;
  const auto path = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::vector<std::string> steps;
  load_scene_file(path, "", [&](const ReadingProgress& progress) {
    steps.push_back(progress.step);
    return true;
  });
  EXPECT_EQ(steps, (std::vector<std::string>{"reading", "converting", "making objects"}));
  for (const std::string& last : steps) {
    const auto stop = [&](const ReadingProgress& progress) { return progress.step != last; };
    EXPECT_THROW(load_scene_file(path, "", stop), ReadingStopped) << last;
  }
}

}  // namespace
}  // namespace isolux
