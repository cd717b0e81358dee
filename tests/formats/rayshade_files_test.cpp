// The examples of Rayshade 4, where they are at hand beside the project.
#include <gtest/gtest.h>

#include <map>

#include "formats/rayshade_text.h"
#include "support/scenes.h"

namespace isolux {
namespace {
namespace fs = std::filesystem;

const fs::path kFolder = shared_dir() / "scenes/rayshade";

class RayshadeFiles : public testing::Test {
 protected:
  void SetUp() override { ISOLUX_NEED_SCENES(); }
};

TEST_F(RayshadeFiles, AllAreRead) {
  struct Counts {
    std::size_t objects, lights, materials;
  };
  const std::map<std::string, Counts> expected = {
      {"ashtray.def", {1, 1, 1}}, {"ashtray", {2, 1, 2}}, {"balls", {11, 3, 2}},
      {"blob", {2, 2, 1}},        {"boxball", {3, 1, 2}}, {"csg", {4, 3, 2}},
      {"glass.def", {1, 1, 1}},   {"glass", {2, 1, 2}},   {"planet", {1, 1, 1}},
      {"pool", {28, 1, 12}},      {"stripe", {1, 1, 1}},
  };
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() != ".ray") continue;
    SCOPED_TRACE(entry.path().filename().string());
    ++files;
    const SceneFile file = load_scene_file(entry.path());
    const Scene& scene = file.scene;
    EXPECT_EQ(scene.name, entry.path().stem().string());
    ASSERT_TRUE(expected.contains(scene.name));
    const Counts& counts = expected.at(scene.name);
    EXPECT_EQ(scene.objects.size(), counts.objects);
    EXPECT_EQ(scene.materials.size(), counts.materials);
    EXPECT_FALSE(file.notes.empty());
    EXPECT_EQ(scene.cameras.size(), 1u);
    std::size_t lights = 0;
    for (const Object& object : scene.objects) {
      lights += object.emits();
      const Bounds box = object.shape->bounds();
      EXPECT_FALSE(box.empty());
      EXPECT_TRUE(is_finite(box.lower) && is_finite(box.upper)) << object.name;
      EXPECT_TRUE(is_finite(object.exitance)) << object.name;
      EXPECT_LT(object.material, scene.materials.size());
    }
    for (const Source& source : scene.sources) {
      EXPECT_TRUE(is_finite(source.position) && is_finite(source.intensity)) << source.name;
    }
    EXPECT_EQ(lights + scene.sources.size(), counts.lights);
    for (const Material& material : scene.materials) {
      EXPECT_GE(min_channel(material.reflectance), 0);
      EXPECT_LT(max_channel(material.reflectance), 1);
    }
  }
  EXPECT_EQ(files, expected.size());
}

// A block that looks like an S from the front (x and z), with a C cut through it from the side
// (y / 0.8 and z / 0.8) and a G from above (x / 0.8 and y / 0.8).
TEST_F(RayshadeFiles, TheCsgBlockIsCutWhereItShouldBe) {
  const Scene scene = load_scene_file(kFolder / "csg.ray").scene;
  const Object& block = scene.objects.at(3);
  ASSERT_EQ(block.name, "csg");
  EXPECT_EQ(scene.materials[block.material].name, "s1");
  ASSERT_TRUE(block.shape->solid());
  const std::pair<Vec3, bool> points[] = {
      {{0.95, 0.95, 0.9}, true},         // the upper bar of the S, beyond C and G
      {{0, 0, 0}, true},                 // its middle bar; the openings of C and G are here
      {{0.3, 0, 0}, false},              // the bar of the G takes it away
      {{-0.1, 0.6, 0}, false},           // the ring of the G
      {{-0.1, -0.6, 0}, false},          // the ring of the C
      {{-0.9, 0.9, 0.9}, false},         // the corner above the S's upper bow
      {{-0.9, 0.95, -0.9}, true},        // its lower bar
      {{-0.9, 0.95, 0.4}, true},         // its upper bow
      {{-0.4875, 0.95, 0.3875}, false},  // the hole in the bow
      {{0, 0.97, 0.4}, false},           // between the upper and the middle bar
      {{0, 0, 1.5}, false},
  };
  for (const auto& [p, inside] : points) {
    EXPECT_EQ(block.shape->contains(p), inside) << p.x << ' ' << p.y << ' ' << p.z;
  }
  // Lines say the same as points.
  for (const auto& [p, inside] : points) {
    Hits hits;
    block.shape->intersect({p, normalized({0.3, 0.2, 0.9})}, hits);
    std::size_t ahead = 0;
    for (const Hit& hit : hits) ahead += hit.t > 0;
    EXPECT_EQ(ahead % 2 == 1, inside) << p.x << ' ' << p.y << ' ' << p.z;
  }
}

// The wall of the drinking glass between its outer and inner cone.
TEST_F(RayshadeFiles, TheGlassIsHollow) {
  const Scene scene = load_scene_file(kFolder / "glass.ray").scene;
  const Shape& glass = *scene.objects.at(0).shape;
  EXPECT_FALSE(glass.contains({0, 0, 1}));
  EXPECT_TRUE(glass.contains({0, 0, 0.05})) << "its bottom";
  EXPECT_TRUE(glass.contains({0.9, 0, 1}));
  EXPECT_TRUE(glass.contains({0.99, 0, 2.03})) << "its rim";
  EXPECT_FALSE(glass.contains({1.02, 0, 1}));
}

TEST_F(RayshadeFiles, TheAshtrayHasItsBowlAndRests) {
  const Scene scene = load_scene_file(kFolder / "ashtray.ray").scene;
  const Shape& ashtray = *scene.objects.at(1).shape;
  EXPECT_TRUE(ashtray.contains({0, 0, -1})) << "the middle, which the torus leaves";
  EXPECT_FALSE(ashtray.contains({3, 0, -1}));
  EXPECT_TRUE(ashtray.contains({4.7, 4.7, -0.1}));
  EXPECT_FALSE(ashtray.contains({0, -4.8, -0.1})) << "a rest for a cigarette";
  EXPECT_TRUE(ashtray.contains({1, -4.8, -0.1})) << "between two rests";
}

}  // namespace
}  // namespace isolux
