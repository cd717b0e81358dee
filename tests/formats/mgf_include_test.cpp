#include <gmock/gmock.h>

#include "formats/mgf_text.h"
#include "formats/temporary_folder.h"
#include "isolux/formats/scene_file.h"

namespace isolux {
namespace {
namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const fs::path& file) {
  try {
    read_mgf(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MgfInclude, MaterialsAndVerticesComeFromLibraries) {
  const TemporaryFolder folder;
  folder.write("lib/all.mgf", "i ./paint.mgf\ni points.mgf\n");
  folder.write("lib/paint.mgf", "m white =\n rd 0.8\n");
  folder.write("lib/points.mgf", kVertices);
  const fs::path main = folder.write("room.mgf", "i lib/all.mgf\nm white\nf o x y\n");
  const Scene scene = load_scene_file(main).scene;
  EXPECT_EQ(scene.name, "room");
  EXPECT_EQ(scene.materials.at(0).name, "white");
  EXPECT_EQ(scene.cameras.at(0).name, "default");
}

TEST(MgfInclude, ATransformMovesWhatIsIncluded) {
  const TemporaryFolder folder;
  folder.write("ball.mgf", kVertices + "o ball\nsph x 1\no\n");
  const fs::path main = folder.write(
      "main.mgf", "o set\nxf -t 0 0 5\ni ball.mgf -a 2 -t 10 0 0\nxf\ni ball.mgf\no\n");
  const Scene scene = read_mgf(main).scene;
  ASSERT_EQ(scene.objects.size(), 3u);
  expect_near(scene.objects[0].shape->bounds().center(), {1, 0, 5});
  expect_near(scene.objects[1].shape->bounds().center(), {11, 0, 5});
  expect_near(scene.objects[2].shape->bounds().center(), {1, 0, 0});
  EXPECT_EQ(scene.objects[2].name, "set/ball 3");
}

TEST(MgfInclude, FaultsAreNamedWhereTheyAre) {
  const TemporaryFolder folder;
  folder.write("bad.mgf", "m a =\n\n rd x\n");
  folder.write("open.mgf", "xf -t 1 0 0\n");
  folder.write("close.mgf", "\nxf\n");
  folder.write("circle.mgf", "i main.mgf\n");
  const auto of = [&](const std::string& text) { return refusal(folder.write("main.mgf", text)); };
  const std::string at = folder.path().string() + '/';
  EXPECT_THAT(of("\ni bad.mgf\n"), StartsWith(at + "bad.mgf:3:5: expected a number"));
  EXPECT_THAT(of("i open.mgf\n"), StartsWith(at + "open.mgf:1:1: this transform is not ended"));
  EXPECT_THAT(of("xf -t 1 0 0\ni close.mgf\n"),
              StartsWith(at + "close.mgf:2:1: no transform is open"));
  EXPECT_THAT(of("i circle.mgf\n"), StartsWith(at + "circle.mgf:1:3: 'main.mgf' includes itself"));
  EXPECT_THAT(of("i ../x.mgf\n"), StartsWith(at + "main.mgf:1:3: '../x.mgf' lies outside"));
  EXPECT_THAT(of("i none.mgf\n"), EndsWith("main.mgf:1:3: there is no file 'none.mgf'"));
  EXPECT_THAT(of("i open.mgf -t 1\n"), HasSubstr("main.mgf:1:12: '-t' needs 3 numbers"));
}

}  // namespace
}  // namespace isolux
