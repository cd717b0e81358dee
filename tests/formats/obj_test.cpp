#include <numbers>

#include "formats/refusal.h"
#include "support/scenes.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// A scene beside a file of materials.
SceneFile with_materials(const std::string& materials, const std::string& text) {
  const TemporaryFolder folder;
  folder.write("a.mtl", materials);
  return load_scene_file(folder.write("a.obj", "mtllib a.mtl\n" + text));
}

TEST(Obj, FacesOfOneGroupAndMaterialAreOneMesh) {
  const SceneFile file = scene_in("a.obj", kSquare +
                                               "g wall\nf 1 2 3 4\ng lid\nf -4 -3 -2\n"
                                               "g wall\nf 3/1/1 4//2 1/7\n");
  const Scene& scene = file.scene;
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].name, "wall");
  EXPECT_NEAR(surface_area(*scene.objects[0].shape).value(), 1, 1e-12);
  EXPECT_NEAR(surface_area(*scene.objects[1].shape).value(), 0.5, 1e-12);
  EXPECT_EQ(scene.objects[0].sides, Sides::both);
  EXPECT_THAT(file.notes, Contains(HasSubstr("taken as metres")));
  EXPECT_THAT(file.notes, Contains(HasSubstr("1 triangle between the same points")));
}

TEST(Obj, FreeFormSurfacesAreNamedAsLeftOut) {
  const SceneFile file = scene_in("a.obj", kSquare +
                                               "f 1 2 3 4\ncstype bspline\ndeg 1 1\n"
                                               "surf 0 1 0 1 1 2 4 3\nparm u 0 0 1 1\n"
                                               "parm v 0 0 1 1\nend\n");
  EXPECT_EQ(file.scene.objects.size(), 1u);
  EXPECT_THAT(file.notes, Contains(HasSubstr("'surf' left out: no free-form geometry")));
}

TEST(Obj, MaterialsGiveReflectanceAndLight) {
  const SceneFile file =
      with_materials("newmtl lamp\nKd 0.25 0.5 1.5\nKe 1 2 3\nKs .1 .1 .1\nd 0.5\n",
                     kSquare + "usemtl lamp\nf 1 2 3 4\n");
  const Scene& scene = file.scene;
  EXPECT_EQ(scene.materials.at(0).reflectance, (Rgb{0.25, 0.5, 0.999}));
  const Rgb& exitance = scene.objects.at(0).exitance;
  EXPECT_NEAR(luminance(exitance), pi * 179 * (0.265 * 1 + 0.670 * 2 + 0.065 * 3), 1e-9);
  EXPECT_NEAR(exitance.b, 3 * exitance.r, 1e-9);
  EXPECT_EQ(scene.objects[0].sides, Sides::front);
  for (const char* note : {"reduced to 0.999", "'Ks' left out", "'d' left out"}) {
    EXPECT_THAT(file.notes, Contains(HasSubstr(note)));
  }
}

TEST(Obj, LibrariesMayBeSeveralOrHaveSpaces) {
  const TemporaryFolder folder;
  folder.write("a.mtl", "newmtl a\nKd 0.1 0.1 0.1\n");
  folder.write("b.mtl", "newmtl b\nKd 0.2 0.2 0.2\n");
  folder.write("c d.mtl", "newmtl c\nKd 0.3 0.3 0.3\n");
  const Scene scene =
      load_scene_file(folder.write("a.obj", "mtllib a.mtl b.mtl\nmtllib c d.mtl\n" + kSquare +
                                                "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n"
                                                "usemtl c\nf 1 2 4\n"))
          .scene;
  ASSERT_EQ(scene.materials.size(), 3u);
  EXPECT_EQ(scene.materials[1].reflectance, gray(0.2));
  EXPECT_EQ(scene.materials[2].reflectance, gray(0.3));
}

// A box around a light faces inward, whichever way its faces are wound; a box beside it outward.
TEST(Obj, ClosedSurfacesFaceWhereTheLightIs) {
  const auto box = [](double from, double size) {
    std::string text;
    for (int i = 0; i < 8; ++i) {
      text += "v";
      for (int axis = 0; axis < 3; ++axis) {
        text += ' ' + std::to_string(from + (i >> axis & 1) * size);
      }
      text += '\n';
    }
    return text +
           "f -8 -4 -2 -6\nf -7 -3 -1 -5\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -6 -5 -7\n"
           "f -4 -3 -1 -2\n";
  };
  const Scene scene =
      with_materials("newmtl wall\nnewmtl lamp\nKe 1 1 1\n",
                     "usemtl wall\ng room\n" + box(0, 4) + "g crate\n" + box(1, 0.5) +
                         "g lamp\nusemtl lamp\nv 2 2 3\nv 2 3 3\nv 3 3 3\nf -3 -2 -1\n")
          .scene;
  EXPECT_TRUE(scene.objects.at(0).shape->unbounded());
  EXPECT_FALSE(scene.objects.at(0).shape->contains({2, 2, 2}));
  EXPECT_TRUE(scene.objects.at(1).shape->contains({1.25, 1.25, 1.25}));
}

TEST(Obj, ErrorsGiveTheExactPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {"v 1 2", "5:1: 'v' lacks an argument: write v x y z"},
      {"v 1 2 x", "5:7: expected a number, not 'x'"},
      {"v 1 nan 3", "5:5: expected a number, not 'nan'"},
      {"v 1 1e999 3", "5:5: '1e999' is not a finite number"},
      {"v 1 2 -2e9", "5:7: must lie between -1e+09 and 1e+09"},
      {"f 1 2", "5:1: 'f' lacks an argument"},
      {"f 1 2 5", "5:7: there is no vertex 5 here, only 4"},
      {"f 1 0 3", "5:5: there is no vertex 0 here, only 4"},
      {"f 1 -5 3", "5:5: there is no vertex -5 here, only 4"},
      {"f 1 2x 3", "5:5: expected the number of a vertex, not '2x'"},
      {"f 1 99999999999999999999 3", "5:5: expected the number of a vertex"},
      {"mtllib no.mtl", "5:8: there is no file 'no.mtl'"},
      {"mtllib ../../x.mtl", "5:8: '../../x.mtl' lies outside the folder"},
      {"usemtl", "5:1: 'usemtl' lacks an argument: write usemtl name"},
      {"", ": the scene has no surfaces"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string place = *expected == ':' ? "a.obj" : "a.obj:";
    EXPECT_THAT(refusal_of("a.obj", kSquare + text + "\n"), StartsWith(place + expected)) << text;
  }
}

TEST(Obj, ErrorsInMaterials) {
  const auto refusal = [](const std::string& materials, const std::string& text) -> std::string {
    try {
      with_materials(materials, text);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refusal("newmtl a\nKd 0.5 -1 0\n", ""),
              HasSubstr("a.mtl:2:8: must not be negative, but is -1"));
  EXPECT_THAT(refusal("newmtl\n", ""), HasSubstr("a.mtl:1:1: 'newmtl' lacks an argument"));
  EXPECT_THAT(refusal("newmtl red\n", "usemtl rod\n"),
              HasSubstr("a.obj:2:8: there is no material 'rod': did you mean 'red'?"));
  EXPECT_THAT(refusal("newmtl a\nKe 1e20 0 0\n", kSquare + "usemtl a\nf 1 2 3\n"),
              HasSubstr("a.obj: a light is stronger than 1e+12 lm/m²"));
}

TEST(Obj, DamagedFilesDoNoHarm) {
  expect_no_harm("a.obj", kSquare + "o box\ng wall\nusemtl red\nf 1 2 3 4\nf -1//1 -2//2 -3//3\n",
                 2000);
}

// McGuire's Cornell box: eight parts drawn under seven pairs of group and material.
TEST(Obj, CornellBox) {
  ISOLUX_NEED_SCENES();
  const auto path = shared_dir() / "scenes/cornell-mcguire/CornellBox-Original.obj";
  const SceneFile file = load_scene_file(path);
  const Scene& scene = file.scene;
  EXPECT_EQ(scene.objects.size(), 7u);
  EXPECT_NEAR(surface_area(*scene.objects.at(0).shape).value(), 0.5 * (2.01 + 1.99) * 2.03, 1e-9);
  EXPECT_EQ(scene.materials.at(4).reflectance, (Rgb{0.999, 0.065, 0.05}));
  const double area = 0.47 * 0.38;
  EXPECT_NEAR(luminous_flux(scene.objects.back()),
              pi * 179 * area * (0.265 * 17 + 0.670 * 12 + 0.065 * 4), 1e-6);
  EXPECT_THAT(file.notes, Contains(HasSubstr("1 material that reflects 1 or more")));
  // The light faces down.
  Hits hits;
  scene.objects.back().shape->intersect({{0, 0, 0}, {0, 1, 0}}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_LT(hits[0].normal.y, 0);
}

}  // namespace
}  // namespace isolux
