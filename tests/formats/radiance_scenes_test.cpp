// The models that come with Radiance, where they are at hand beside the project.
#include <gmock/gmock.h>

#include <map>
#include <numbers>

#include "formats/radiance_text.h"
#include "isolux/formats/scene_file.h"
#include "support/scenes.h"

namespace isolux {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kScenes = shared_dir() / "scenes";

class RadianceScenes : public testing::Test {
 protected:
  void SetUp() override { ISOLUX_NEED_SCENES(); }
};

SceneFile load(const std::string& name) {
  return load_scene_file(kScenes / "radiance-obj" / name, "radiance");
}

TEST_F(RadianceScenes, AllAreRead) {
  struct Counts {
    std::size_t surfaces, lights;
  };
  const std::map<std::string, Counts> expected = {
      {"misc/daf.rad", {58, 2}},
      {"misc/daf.rif", {58, 2}},
      {"misc/daffodil", {50, 0}},
      {"misc/examp", {8, 1}},
      {"misc/room", {8, 2}},
      {"office/blinds", {24, 0}},
      {"office/book.norm", {21, 0}},
      {"office/bookbox.norm", {32, 0}},
      {"office/chair1.norm", {97, 0}},
      {"office/chair2.norm", {83, 0}},
      {"office/cornerdesk.norm", {116, 0}},
      {"office/desk", {243, 0}},
      {"office/lamp", {18, 1}},
      {"office/lamp.off", {18, 0}},
      {"office/lights", {2, 2}},
      {"office/lights.off", {2, 0}},
      {"office/misc", {245, 0}},
      {"office/misc.badchair", {245, 0}},
      {"office/model.b90", {6, 0}},
      {"office/mug.norm", {25, 0}},
      {"office/office.rif", {540, 3}},
      {"office/officeday.rif", {538, 1}},
      {"office/officeday2.rif", {538, 1}},
      {"office/officedayM.rif", {538, 1}},
      {"office/officelamp.rif", {538, 1}},
      {"office/openbook.norm", {102, 0}},
      {"office/picture", {2, 0}},
      {"office/skywindow", {1, 1}},
      {"office/window_src.rad", {1, 1}},
      {"virtual/desk.rad", {96, 0}},
      {"virtual/draft_ang.rad", {145, 0}},
      {"virtual/draft_flat.rad", {145, 0}},
      {"virtual/environ.rad", {6, 0}},
      {"virtual/furniture.rad", {2916, 0}},
      {"virtual/furnrev.rad", {2888, 0}},
      {"virtual/illum.rif", {2943, 0}},
      {"virtual/illumoff.rad", {56, 24}},
      {"virtual/mug.rad", {25, 0}},
      {"virtual/orange_chair.rad", {97, 0}},
      {"virtual/outside.rif", {27, 0}},
      {"virtual/plain.rif", {2943, 0}},
      {"virtual/plainoff.rad", {21, 0}},
      {"virtual/stool.rad", {198, 0}},
      {"virtual/wastebasket.rad", {441, 0}},
  };
  for (const auto& [name, counts] : expected) {
    SCOPED_TRACE(name);
    const Scene scene = load(name).scene;
    EXPECT_EQ(scene.objects.size(), counts.surfaces);
    EXPECT_FALSE(scene.cameras.empty());
    std::size_t lights = 0;
    for (const Object& object : scene.objects) {
      lights += object.emits();
      EXPECT_GT(surface_area(*object.shape).value(), 0) << object.name;
      EXPECT_TRUE(is_finite(object.exitance));
    }
    EXPECT_EQ(lights, counts.lights);
    for (const Material& material : scene.materials) {
      EXPECT_GE(min_channel(material.reflectance), 0) << material.name;
      EXPECT_LT(max_channel(material.reflectance), 1) << material.name;
    }
  }
}

// Parts of larger scenes, of nothing but glass, sky and surfaces that a program replaces.
TEST_F(RadianceScenes, PartsWithoutADiffuseSurfaceAreRefused) {
  for (const std::string name : {"window", "sky", "illum.rad", "illum0.rad", "illum1.rad"}) {
    try {
      load("office/" + name);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(":1:1: ")) << name;
    }
  }
}

// The ball of gold in a box of sky, lit by a bulb.
TEST_F(RadianceScenes, Example) {
  const Scene scene = load("misc/examp").scene;
  expect_near(scene.bounds().upper, {10, 5, 8});
  EXPECT_NEAR(total_flux(scene), 250 * 179 * std::numbers::pi * 4 * std::numbers::pi * 0.4 * 0.4,
              1e-6);
  EXPECT_EQ(scene.camera("").name, "examp");
}

// The room on top of Building 90, in Radiance's own files (in units of 3 inches) and as converted
// to MGF long ago. The window (glass) is in the latter alone, the hanging picture in the former;
// all else, 538 surfaces, is in both, those of a box in another order.
TEST_F(RadianceScenes, TheOfficeIsThatOfItsMgfVersion) {
  constexpr double kUnit = 0.0762;  // m
  const Scene scene = load("office/office.rif").scene;
  EXPECT_EQ(scene.camera("").name, "norm");
  std::vector<Object> left = scene.objects;
  ASSERT_EQ(left.size(), 540u);
  const Scene mgf = load_scene_file(kScenes / "mgf-renderpark/office3/office.mgf").scene;
  ASSERT_EQ(mgf.objects.size(), 539u);
  for (const Object& object : mgf.objects) {
    if (object.name == "window") continue;
    const Bounds a = object.shape->bounds();
    const double area = surface_area(*object.shape).value();
    const auto twin = std::find_if(left.begin(), left.end(), [&](const Object& other) {
      const Bounds b = other.shape->bounds();
      const double its = surface_area(*other.shape).value() * kUnit * kUnit;
      return distance(a.lower, b.lower * kUnit) < 1e-5 &&
             distance(a.upper, b.upper * kUnit) < 1e-5 && std::abs(its - area) < 1e-4 * area &&
             object.emits() == other.emits();
    });
    ASSERT_NE(twin, left.end()) << object.name;
    left.erase(twin);
  }
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].name, "painting");
  EXPECT_EQ(left[1].name, "mat");
}

}  // namespace
}  // namespace isolux
