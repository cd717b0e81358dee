#include <gmock/gmock.h>

#include <numbers>

#include "formats/mgf_text.h"
#include "isolux/formats/default_camera.h"
#include "isolux/formats/scene_file.h"
#include "support/scenes.h"

// Scenes that are kept beside the project: RenderPark's and Radiance's.

namespace isolux {
namespace {
using std::numbers::pi;
using testing::HasSubstr;
using testing::IsEmpty;

SceneFile load(const std::string& name) { return load_scene_file(shared_dir() / "scenes" / name); }

std::size_t lights(const Scene& scene) {
  return std::count_if(scene.objects.begin(), scene.objects.end(),
                       [](const Object& o) { return o.emits(); });
}

double flux(const Scene& scene) {
  double sum = 0;
  for (const Object& o : scene.objects) sum += luminous_flux(o);
  return sum;
}

void expect_sound(const Scene& scene) {
  for (const Object& o : scene.objects) {
    EXPECT_TRUE(is_finite(o.shape->bounds().lower) && is_finite(o.shape->bounds().upper));
    EXPECT_GT(surface_area(*o.shape).value(), 0) << o.name;
    EXPECT_TRUE(is_finite(o.exitance));
    EXPECT_LT(o.material, scene.materials.size());
  }
  for (const Material& m : scene.materials) {
    EXPECT_GE(min_channel(m.reflectance), 0) << m.name;
    EXPECT_LT(max_channel(m.reflectance), 1) << m.name;
  }
}

TEST(MgfScenes, Cube) {
  ISOLUX_NEED_SCENES();
  const Scene scene = load("mgf-renderpark/cube.mgf").scene;
  expect_sound(scene);
  EXPECT_EQ(scene.objects.size(), 66u);
  EXPECT_EQ(lights(scene), 2u);
  EXPECT_NEAR(flux(scene), 200'000, 1e-6);  // 1 m² of 200 000 lm/m²
  expect_near(scene.bounds().upper, {10, 9.8, 10}, 2e-6);
}

// 14 faces, of which 4 are lights in arrays of 19, 10, 18 and 10; two cylinders, a torus, a sphere.
TEST(MgfScenes, Corridor) {
  ISOLUX_NEED_SCENES();
  const SceneFile file = load("mgf-renderpark/corridor.mgf");
  const Scene& scene = file.scene;
  expect_sound(scene);
  EXPECT_EQ(scene.objects.size(), 10u + 57 + 4);
  EXPECT_EQ(lights(scene), 57u);
  EXPECT_NEAR(flux(scene), 57 * 0.4 * 0.4 * 250'000, 1e-6);
  expect_near(scene.bounds().lower, {-5, 0, 0});
  expect_near(scene.bounds().upper, {15, 20, 10});
  double area = 0;
  for (const Object& o : scene.objects) area += surface_area(*o.shape).value();
  // Floor and ceiling; door; walls; shelf of two triangles and a front; pillar, rod, torus, ball.
  const double expected = 2 * 300 + 100 + (200 + 200 + 100 + 100) + 2 * 8 +
                          0.3 * 4 * std::sqrt(2.0) + 57 * 0.16 + 2 * pi * 0.3 * 10 +
                          2 * pi * 0.1 * 1 + 4 * pi * pi * 1.25 * 0.15 + 4 * pi * 0.64;
  EXPECT_NEAR(area, expected, 1e-9);
  EXPECT_THAT(file.notes,
              testing::Contains(HasSubstr("8 materials with specular reflectance (rs)")));
}

TEST(MgfScenes, Soda) {
  ISOLUX_NEED_SCENES();
  for (const std::string name : {"mgf-renderpark/soda.mgf", "mgf-diffuse/soda.mgf"}) {
    const SceneFile file = load(name);
    const Scene& scene = file.scene;
    expect_sound(scene);
    EXPECT_EQ(scene.objects.size(), 331u + 274 + 575 + 461 + 70);
    EXPECT_EQ(lights(scene), 5u);
    EXPECT_NEAR(flux(scene), 1625.355, 1e-3);
    EXPECT_EQ(guessed_up_axis(scene), 1);
    EXPECT_NEAR(scene.bounds().upper.y, 96 * 0.0254, 1e-12);
    EXPECT_EQ(file.notes.empty(), name != "mgf-renderpark/soda.mgf");
  }
}

TEST(MgfScenes, Office3) {
  ISOLUX_NEED_SCENES();
  for (const std::string name : {"mgf-renderpark/office3/office.mgf", "mgf-diffuse/office3.mgf"}) {
    const Scene scene = load(name).scene;
    expect_sound(scene);
    EXPECT_EQ(scene.objects.size(), 319u + 77 + 114 + 16 + 13);
    EXPECT_EQ(lights(scene), 3u);
    EXPECT_NEAR(flux(scene), 16'718.016, 1e-3);
    EXPECT_EQ(guessed_up_axis(scene), 1);
    // The first wall has a window: 60 by 35.5 units less 47 by 17, of 3 inches each.
    EXPECT_EQ(scene.objects[0].name, "wall");
    EXPECT_NEAR(surface_area(*scene.objects[0].shape).value(),
                (60 * 35.5 - 47 * 17) * 0.0762 * 0.0762, 1e-9);
    EXPECT_TRUE(hits_along(*scene.objects[0].shape, Vec3{0, 35, 0} * 0.0762, {0, 0, 1}).empty());
  }
}

TEST(MgfScenes, Office2) {
  ISOLUX_NEED_SCENES();
  const SceneFile file = load("mgf-renderpark/office2/office2.mgf");
  expect_sound(file.scene);
  EXPECT_EQ(file.scene.objects.size(), 422u);
  EXPECT_EQ(lights(file.scene), 1u);
  EXPECT_NEAR(flux(file.scene), 2600, 1e-6);
  EXPECT_EQ(guessed_up_axis(file.scene), 2);
}

TEST(MgfScenes, GlossyFloor) {
  ISOLUX_NEED_SCENES();
  const Scene scene = load("mgf-renderpark/floor_gloss.mgf").scene;
  expect_sound(scene);
  EXPECT_EQ(scene.objects.size(), 9u);
  EXPECT_NEAR(flux(scene), 10'000 * 0.2 * 0.2 * std::sqrt(2.0), 1e-6);
}

// Half of it is mirrored: 2 × (1 cylinder, 17 + 2 + 5 − 5 = 19 faces, 2 prisms); 15 vanes of 4
// faces.
TEST(MgfScenes, Luminaire) {
  ISOLUX_NEED_SCENES();
  for (const std::string name : {"mgf-renderpark/examp1.mgf", "mgf-radiance/examp1.mgf"}) {
    const SceneFile file = load(name);
    const Scene& scene = file.scene;
    expect_sound(scene);
    EXPECT_EQ(scene.objects.size(), 2u * (1 + 19 + 2) + 15 * 4);
    EXPECT_EQ(lights(scene), 2u);
    EXPECT_NEAR(flux(scene), 2 * 44'700 * 2 * pi * 0.5 * 48 * 0.0254 * 0.0254, 1e-6);
    EXPECT_EQ(scene.objects[2].name, "casing/outer");
    // The casing's bottom looks down, and its mirror image does too.
    for (const std::size_t i : {2u, 3u}) {
      const Vec3 c = scene.objects[i].shape->bounds().center();
      const Hits hits = hits_along(*scene.objects[i].shape, c, {0, 0, 1});
      ASSERT_EQ(hits.size(), 1u);
      EXPECT_LT(hits[0].normal.z, -0.9);
      EXPECT_GT(hits[0].normal.y * c.y, 0);
    }
    // The ends are solid plates: 1/8 inch thick.
    for (const Object& o : scene.objects) {
      if (o.name.find("end") == std::string::npos) continue;
      EXPECT_TRUE(o.shape->solid());
      EXPECT_FALSE(o.shape->unbounded());
      EXPECT_NEAR(o.shape->bounds().upper.x - o.shape->bounds().lower.x, 0.125 * 0.0254, 1e-12);
    }
  }
}

TEST(MgfScenes, MaterialLibraries) {
  ISOLUX_NEED_SCENES();
  const SceneFile file = load("mgf-renderpark/Materials/test.mgf");
  expect_sound(file.scene);
  EXPECT_EQ(file.scene.objects.size(), 2u);
  EXPECT_EQ(file.scene.materials.at(0).name, "OakWood");
}

}  // namespace
}  // namespace isolux
