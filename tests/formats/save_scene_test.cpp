#include <gmock/gmock.h>

#include <filesystem>

#include "formats/one_object.h"
#include "isolux/core/file.h"
#include "isolux/formats/radiance/write_radiance.h"
#include "isolux/formats/save_scene.h"
#include "isolux/formats/scene_file.h"
#include "isolux/geometry/height_field.h"
#include "isolux/geometry/sphere.h"

namespace isolux {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;
using testing::StartsWith;

class SaveScene : public testing::Test {
 protected:
  SaveScene() { fs::create_directories(folder_); }
  ~SaveScene() override { fs::remove_all(folder_); }

  const fs::path folder_ =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(SaveScene, TheExtensionNamesTheFormat) {
  const Scene scene = one_object(std::make_shared<Sphere>(Vec3{}, 1));
  for (const auto& [name, start] : {std::pair{"a.yaml", "isolux: 1\n"},
                                    {"a.yml", "isolux: 1\n"},
                                    {"a.mgf", "m gray"},
                                    {"a.rad", "void plastic gray"}}) {
    EXPECT_THAT(save_scene(scene, folder_ / name), IsEmpty());
    EXPECT_THAT(read_file(folder_ / name), StartsWith(start));
  }
  EXPECT_THROW(save_scene(scene, folder_ / "a.obj"), InputError);
}

TEST_F(SaveScene, NothingIsWrittenWhereAnObjectCantBe) {
  // More than 10⁶ triangles.
  const std::vector<std::vector<double>> heights(1000, std::vector<double>(1000, 0.5));
  const Scene scene =
      one_object(std::make_shared<HeightField>(Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, heights));
  EXPECT_THAT(refusal(write_radiance, scene), StartsWith("object 'thing' can't be written: "));
  EXPECT_THROW(save_scene(scene, folder_ / "a.rad"), InputError);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(SaveScene, ItsNativeFileIsLoadedAsTheSceneItWas) {
  save_scene(one_object(std::make_shared<Sphere>(Vec3{}, 1)), folder_ / "a.yaml");
  const SceneFile file = load_scene_file(folder_ / "a.yaml");
  EXPECT_THAT(file.notes, IsEmpty());
  EXPECT_EQ(file.scene.source, read_file(folder_ / "a.yaml"));
  ASSERT_EQ(file.scene.objects.size(), 1u);
  EXPECT_EQ(file.scene.objects[0].name, "thing");
}

}  // namespace
}  // namespace isolux
