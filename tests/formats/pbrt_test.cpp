#include <numbers>

#include "formats/refusal.h"
#include "isolux/geometry/instance.h"
#include "support/scenes.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kTriangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";

TEST(Pbrt, TransformsNest) {
  const Scene scene =
      scene_in("a.pbrt", "WorldBegin\nTranslate 0 0 1\nAttributeBegin\nScale 2 2 2\n" + kTriangle +
                             "AttributeEnd\nRotate 90 0 0 1\n" + kTriangle)
          .scene;
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_LT(distance(scene.objects[0].shape->bounds().upper, {2, 2, 1}), 1e-12);
  EXPECT_LT(distance(scene.objects[1].shape->bounds().lower, {-1, 0, 1}), 1e-12);
}

TEST(Pbrt, ShapesHaveTheirArea) {
  const std::pair<const char*, double> cases[] = {
      {"\"sphere\" \"float radius\" 2", 16 * pi},
      {"\"disk\" \"float radius\" 2 \"float innerradius\" 1", 3 * pi},
      {"\"cylinder\" \"float radius\" 1 \"float zmin\" 0 \"float zmax\" 3", 6 * pi},
      {"\"bilinearmesh\" \"point3 P\" [0 0 0 2 0 0 0 3 0 2 3 0]", 6},
      {"\"trianglemesh\" \"integer indices\" [0 1 2 2 1 3] \"point P\" [0 0 0 1 0 0 0 1 0 1 1 0]",
       1},
  };
  for (const auto& [text, area] : cases) {
    const Scene scene = scene_in("a.pbrt", std::string("WorldBegin Shape ") + text).scene;
    EXPECT_NEAR(surface_area(*scene.objects.at(0).shape).value(), area, 1e-9) << text;
  }
}

// A quarter of a tube of radius 1 and height 2, whose points come times their weight.
const std::string kTube =
    "Shape \"nurbs\" \"integer nu\" 3 \"integer uorder\" 3 \"float uknots\" [0 0 0 1 1 1] "
    "\"integer nv\" 2 \"integer vorder\" 2 \"float vknots\" [0 0 1 1] "
    "\"float Pw\" [1 0 0 1  .70710678118654752 .70710678118654752 0 .70710678118654752  0 1 0 1"
    " 1 0 2 1  .70710678118654752 .70710678118654752 1.4142135623730951 .70710678118654752"
    " 0 1 2 1]";

TEST(Pbrt, NurbsAreTrueSurfaces) {
  const SceneFile file = scene_in("a.pbrt", "WorldBegin Translate 0 0 5 " + kTube);
  const Shape& tube = *file.scene.objects.at(0).shape;
  EXPECT_NEAR(surface_area(tube).value(), pi, 1e-9);
  Hits hits;
  tube.intersect({{0, 0, 6}, {0.6, 0.8, 0}}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(hits[0].t, 1, 1e-12);
  EXPECT_LT(distance(hits[0].normal, {0.6, 0.8, 0}), 1e-9);

  const std::string flat =
      "\"integer nu\" 2 \"integer nv\" 2 \"integer vorder\" 2 \"float vknots\" [0 0 1 1] "
      "\"float uknots\" [0 0 1 1] \"point P\" [0 0 0 2 0 0 0 3 0 2 3 0] \"integer uorder\" ";
  const SceneFile plain = scene_in("a.pbrt", "WorldBegin Shape \"nurbs\" \"float u1\" .5 " + flat +
                                                 "2\n" + "Shape \"nurbs\" " + flat + "5");
  ASSERT_EQ(plain.scene.objects.size(), 1u);
  EXPECT_NEAR(surface_area(*plain.scene.objects[0].shape).value(), 6, 1e-12);
  EXPECT_THAT(plain.notes, Contains("NURBS that end before their knots do: made whole"));
  EXPECT_THAT(plain.notes, Contains(HasSubstr("NURBS up to degree 3: left out")));
}

TEST(Pbrt, MaterialsOfBothVersions) {
  const SceneFile file = scene_in(
      "a.pbrt",
      "WorldBegin\nTexture \"board\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.2 .4 .6] "
      "\"rgb tex2\" [0 0 0]\n"
      "MakeNamedMaterial \"red\" \"string type\" \"matte\" \"color Kd\" [.6 .1 0]\n"
      "NamedMaterial \"red\"\n" +
          kTriangle + "Material \"diffuse\" \"texture reflectance\" \"board\"\n" + kTriangle +
          "Material \"conductor\"\n" + kTriangle);
  const auto& materials = file.scene.materials;
  ASSERT_EQ(materials.size(), 3u);
  EXPECT_EQ(materials[0].name, "red");
  EXPECT_EQ(materials[0].reflectance, (Rgb{0.6, 0.1, 0}));
  EXPECT_NEAR(materials[1].reflectance.b, 0.3, 1e-12);
  EXPECT_THAT(file.notes, Contains(HasSubstr("not diffuse: taken as diffuse")));
}

TEST(Pbrt, LightsAreMeasuredByTheEye) {
  const Scene scene =
      scene_in("a.pbrt",
               "WorldBegin\n"
               "LightSource \"point\" \"rgb I\" [1 2 3] \"point3 from\" [0 0 5]\n"
               "LightSource \"distant\" \"rgb L\" [2 2 2] \"point3 from\" [0 0 1] "
               "\"point3 to\" [0 0 0]\n"
               "LightSource \"spot\" \"float coneangle\" 40 \"float conedeltaangle\" 10\n"
               "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"float scale\" 2\n" +
                   kTriangle + "ReverseOrientation\n" + kTriangle +
                   "AreaLightSource \"diffuse\" \"float power\" 50\n" + kTriangle +
                   "AttributeEnd\n" + kTriangle)
          .scene;
  ASSERT_EQ(scene.sources.size(), 3u);
  const Rgb& intensity = scene.sources[0].intensity;
  EXPECT_NEAR(luminance(intensity), 179 * (0.265 * 1 + 0.670 * 2 + 0.065 * 3), 1e-9);
  EXPECT_NEAR(intensity.b, 3 * intensity.r, 1e-9);
  EXPECT_EQ(scene.sources[0].position, (Vec3{0, 0, 5}));
  EXPECT_EQ(scene.sources[1].direction, (Vec3{0, 0, -1}));
  EXPECT_NEAR(scene.sources[2].full_angle, 30, 1e-12);
  ASSERT_EQ(scene.objects.size(), 4u);
  EXPECT_NEAR(scene.objects[0].exitance.r, 2 * 179 * pi, 1e-9);
  EXPECT_NEAR(luminous_flux(scene.objects[2]), 50, 1e-9);
  EXPECT_FALSE(scene.objects[3].emits());
  for (const std::size_t i : {0u, 1u}) {
    Hits hits;
    scene.objects[i].shape->intersect({{0.2, 0.2, -1}, {0, 0, 1}}, hits);
    EXPECT_NEAR(hits.at(0).normal.z, i == 0 ? 1 : -1, 1e-12);
  }
}

TEST(Pbrt, ObjectsArePlacedByInstances) {
  const Scene scene =
      scene_in("a.pbrt", "WorldBegin ObjectBegin \"pair\"\nTranslate 1 0 0\n" + kTriangle +
                             "Shape \"sphere\"\nObjectEnd\nObjectInstance \"pair\"\n"
                             "Scale 2 2 2\nObjectInstance \"pair\"\n")
          .scene;
  ASSERT_EQ(scene.objects.size(), 4u);
  EXPECT_LT(distance(scene.objects[3].shape->bounds().center(), {2, 0, 0}), 1e-12);
  EXPECT_NEAR(surface_area(*scene.objects[3].shape).value(), 16 * pi, 1e-9);
}

TEST(Pbrt, InstancesOfAMeshAreOneInMemory) {
  const Scene scene =
      scene_in(
          "a.pbrt",
          "WorldBegin ObjectBegin \"square\"\nShape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 "
          "1 1 0 0 1 0] \"integer indices\" [0 1 2 0 2 3]\nObjectEnd\n"
          "ObjectInstance \"square\"\nRotate 30 1 2 3\nObjectInstance \"square\"\n")
          .scene;
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(original(scene.objects[0].shape).shape, original(scene.objects[1].shape).shape);
}

// Names are relative to the folder of the main file, wherever they stand.
TEST(Pbrt, FilesIncludeOthers) {
  const TemporaryFolder folder;
  folder.write("parts/a.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_index\n"
               "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  folder.write("parts/part.pbrt", "Shape \"plymesh\" \"string filename\" \"parts/a.ply\"\n");
  const auto file = folder.write("a.pbrt", "WorldBegin\nInclude \"parts/part.pbrt\"\n");
  EXPECT_EQ(load_scene_file(file).scene.objects.size(), 1u);
}

TEST(Pbrt, ErrorsGiveTheExactPlace) {
  const std::string kPlane =
      "Shape \"nurbs\" \"integer nu\" 2 \"integer nv\" 2 \"integer uorder\" 2 "
      "\"float uknots\" [0 0 1 1] \"float vknots\" [0 0 1 1]\n";
  const std::pair<std::string, const char*> cases[] = {
      {"Shap \"sphere\"", "1:1: unknown directive 'Shap': did you mean 'Shape'?"},
      {"Shape sphere", "1:7: 'Shape' needs a text in quotes here"},
      {"Shape \"sphere", "1:7: this text is not closed"},
      {"Translate 1 2", "1:14: 'Translate' needs 3 numbers"},
      {"Translate 1 2 1e999", "1:15: '1e999' is no finite number"},
      {"Scale 1 0 1", "1:1: the transform flattens everything"},
      {"Rotate 90 0 0 0", "1:1: the axis of 'Rotate' must not be zero"},
      {"LookAt 0 0 0 0 0 1 0 0 1", "1:1: 'LookAt' needs 'up' not along the view"},
      {"Transform [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0]", "1:41: 'Transform' needs 16 numbers"},
      {"AttributeBegin", "1:15: the file ends without 'AttributeEnd'"},
      {"AttributeEnd", "1:1: 'AttributeEnd' has nothing to end here"},
      {"NamedMaterial \"red\"", "1:15: there is no material 'red': there are none"},
      {"ObjectInstance \"a\"", "1:16: there is no object 'a'"},
      {"CoordSysTransform \"a\"", "1:19: there is no 'a'"},
      {"Shape \"sphere\" \"float radius\" -1", "1:1: radius: must be a length"},
      {"Shape \"sphere\" \"radius\" 1", "1:16: expected a type and a name, not 'radius'"},
      {"Shape \"sphere\" \"float radius\" [1 2]", "1:16: 'radius' must be one number"},
      {"Shape \"sphere\" \"float radius\" [1", "1:33: the file ends within a directive"},
      {"Shape \"trianglemesh\" \"point P\" [0 0 0 1 0 0 0 1 0]\n \"integer indices\" [0 1 3]",
       "2:2: there is no point 3, only 3 of them"},
      {"Shape \"plymesh\" \"string filename\" \"../a.ply\"",
       "1:17: '../a.ply' lies outside the folder"},
      {"Include \"/etc/passwd\"", "1:9: '/etc/passwd' can't be included"},
      {"Include \"a.pbrt\"", "1:9: 'a.pbrt' includes itself"},
      {"Material \"matte\" \"rgb Kd\" [1 -1 0]", "1:18: 'Kd' must not be negative"},
      {"\nShape \"nurbs\"", "2:1: 'nurbs' lacks 'uorder'"},
      {kPlane + "\"integer vorder\" 1.5", "2:1: 'vorder' must be a whole number from 1 on"},
      {kPlane + "\"integer vorder\" 2\n\"point P\" [0 0 0 1 0 0]",
       "3:1: 2 by 2 points take 12 numbers, not 6"},
      {kPlane + "\"integer vorder\" 1 \"point P\" [0 0 0 1 0 0 0 1 0 1 1 0]",
       "1:1: v_knots: the degree must be 1 to 3, not 0"},
      {kPlane + "\"integer vorder\" 2 \"float Pw\" [0 0 0 1 1 0 0 1 0 1 0 1 1 1 0 0]",
       "1:1: weights: must be more than 0, not 0"},
      {"Camera \"perspective\" \"float fov\" 180", "1:22: 'fov' must lie between 0 and 180"},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_THAT(refusal_of("a.pbrt", text), StartsWith(std::string("a.pbrt:") + expected)) << text;
  }
  EXPECT_EQ(refusal_of("a.pbrt", ""), "a.pbrt: the scene has no surfaces");
}

TEST(Pbrt, DamagedNurbsDoNoHarm) { expect_no_harm("a.pbrt", "WorldBegin " + kTube, 1000); }

TEST(Pbrt, DamagedFilesDoNoHarm) {
  expect_no_harm("a.pbrt",
                 "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n"
                 "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n" +
                     kTriangle +
                     "AttributeEnd\nObjectBegin \"o\"\nShape \"sphere\"\nObjectEnd\n"
                     "Rotate 30 0 1 0\nObjectInstance \"o\"\n",
                 2000);
}

// Bitterli's Cornell box: five walls of 2 m, two boxes and the light.
TEST(Pbrt, CornellBox) {
  ISOLUX_NEED_SCENES();
  const auto path = shared_dir() / "scenes/cornell-tungsten/scene.pbrt";
  const Scene scene = load_scene_file(path).scene;
  ASSERT_EQ(scene.objects.size(), 8u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(surface_area(*scene.objects[i].shape).value(), 4, 1e-6);
    EXPECT_EQ(scene.objects[i].shape->face_count(), 1u);
  }
  const Object& light = scene.objects[7];
  EXPECT_NEAR(luminous_flux(light), pi * 179 * 0.47 * 0.38 * (0.265 * 17 + 0.670 * 12 + 0.065 * 4),
              1e-6);
  Hits hits;
  light.shape->intersect({{0, 0, 0}, {0, 1, 0}}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_LT(hits[0].normal.y, 0);
  const Camera& camera = scene.cameras.at(0);
  EXPECT_LT(distance(camera.eye, {0, 1, 6.8}), 1e-9);
  EXPECT_LT(distance(camera.look_at, {0, 1, 5.8}), 1e-9);
  EXPECT_NEAR(camera.fov, 19.5, 1e-9);
}

}  // namespace
}  // namespace isolux
