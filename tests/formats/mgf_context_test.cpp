#include <gmock/gmock.h>

#include "formats/mgf_text.h"
#include "isolux/scene/scene.h"

namespace isolux {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Rgb reflectance(const std::string& material) {
  const SceneFile file = read_text(kVertices + material + "\nsph o 1\n");
  return file.scene.material_of(0).reflectance;
}

void expect_near(const Rgb& a, const Rgb& b, double tolerance) {
  EXPECT_NEAR(a.r, b.r, tolerance);
  EXPECT_NEAR(a.g, b.g, tolerance);
  EXPECT_NEAR(a.b, b.b, tolerance);
}

TEST(MgfContext, UnnamedContextsHaveTheirDefaults) {
  const SceneFile file = read_text(kVertices + "f o x y\n");
  const Object& face = file.scene.objects.at(0);
  EXPECT_EQ(file.scene.material_of(0).reflectance, Rgb{});
  EXPECT_EQ(file.scene.material_of(0).name, "unnamed");
  EXPECT_EQ(face.sides, Sides::both);
  EXPECT_FALSE(face.emits());
  EXPECT_THAT(file.notes, IsEmpty());
  // Changes to an unnamed context are lost when it is selected anew.
  expect_near(reflectance("rd 0.5"), gray(0.5), 1e-12);
  expect_near(reflectance("rd 0.5\nm"), gray(0), 0);
  expect_near(reflectance("cxy 0.5 0.4\nc\nrd 0.5"), gray(0.5), 1e-12);
}

TEST(MgfContext, NamedContextsAreKeptAndChanged) {
  expect_near(reflectance("m a =\nrd 0.3\nm b =\nrd 0.6\nm a"), gray(0.3), 1e-12);
  expect_near(reflectance("m a =\nrd 0.3\nm\nm a\nrd 0.4\nm\nm a"), gray(0.4), 1e-12);
  expect_near(reflectance("m a =\nrd 0.3\nm a ="), gray(0), 0);
}

TEST(MgfContext, TemplatesAreCopied) {
  expect_near(reflectance("m a =\nrd 0.3\nm b = a\nsides 1\nm a\nrd 0.9\nm b"), gray(0.3), 1e-12);
  expect_near(reflectance("m a =\nrd 0.3\nm a = a\nsides 1"), gray(0.3), 1e-12);
}

TEST(MgfContext, ChangesDoNotReachEarlierUses) {
  const SceneFile file =
      read_text(kVertices + "m a =\nrd 0.3\nsph x 1\nrd 0.6\nsph y 1\nv x\np 9 9 9\n");
  expect_near(file.scene.material_of(0).reflectance, gray(0.3), 1e-12);
  expect_near(file.scene.material_of(1).reflectance, gray(0.6), 1e-12);
  EXPECT_EQ(file.scene.objects[0].shape->bounds().upper.x, 2);
  EXPECT_EQ(file.scene.materials.at(0).name, "a");
  EXPECT_EQ(file.scene.materials.at(1).name, "a 2");
}

TEST(MgfContext, MaterialsAreListedOnce) {
  const SceneFile file =
      read_text(kVertices +
                "m a =\nrd 0.3\nm b =\nrd 0.3\nm unused =\nm a\nsph x 1\nm b\nsph y 1\nm a\n"
                "sph z 1\nm a =\nrd 0.3\nsph o 1\n");
  ASSERT_EQ(file.scene.materials.size(), 2u);
  EXPECT_EQ(file.scene.objects[2].material, 0u);
  EXPECT_EQ(file.scene.objects[3].material, 0u);
}

TEST(MgfContext, SidesOfOpenSurfaces) {
  EXPECT_EQ(only_object(kVertices + "sides 1\nf o x y\n").sides, Sides::front);
  EXPECT_EQ(only_object(kVertices + "sides 2\nf o x y\n").sides, Sides::both);
  EXPECT_EQ(only_object(kVertices + "sides 2\nsph o 1\n").sides, Sides::front);  // solid
}

TEST(MgfContext, ObjectsNestInNames) {
  const SceneFile file =
      read_text(kVertices +
                "sph x 1\no room\nsph x 1\no lamp\nsph x 1\nsph x 1\no\nsph y 1\no\n"
                "cyl o 1 z\n");
  std::vector<std::string> names;
  for (const Object& o : file.scene.objects) names.push_back(o.name);
  EXPECT_THAT(names, ElementsAre("sph", "room", "room/lamp", "room/lamp 2", "room 2", "cyl"));
}

TEST(MgfContext, OnlyDiffuseReflectanceIsKept) {
  const SceneFile file = read_text(kVertices +
                                   "m glossy =\nrd 0.3\nrs 0.4 0.05\nir 1.5 0\nm glass =\ntd 0.2\n"
                                   "ts 0.5 0\nm\nm glossy\nf o x y\nm glass\nf o x xy\nf o xy y\n");
  expect_near(file.scene.materials.at(0).reflectance, gray(0.3), 1e-12);
  expect_near(file.scene.materials.at(1).reflectance, gray(0), 0);
  EXPECT_THAT(file.notes,
              ElementsAre(HasSubstr("1 material with specular reflectance (rs): absorbed"),
                          HasSubstr("1 material with transmittance (td, ts): absorbed"),
                          "1 material with an index of refraction (ir): ignored"));
}

TEST(MgfContext, AReflectanceOf1IsClamped) {
  const SceneFile file = read_text(kVertices + "rd 1\nf o x y\n");
  expect_near(file.scene.material_of(0).reflectance, gray(0.999), 1e-12);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("reduced to 0.999")));
}

TEST(MgfContext, EmittanceIsPhotometricWhateverItsColour) {
  for (const std::string color :
       {"", "cxy 0.45 0.41", "cxy 0.7 0.25", "cct 3000", "cxy 0.1 0.05"}) {
    const Object light = only_object(kVertices + "sides 1\n" + color + "\ned 250\nf o x y\n");
    EXPECT_NEAR(luminance(light.exitance), 250, 1e-9) << color;
    EXPECT_GE(min_channel(light.exitance), 0) << color;
    EXPECT_NEAR(luminous_flux(light), 125, 1e-9) << color;
  }
}

TEST(MgfContext, TwoSidedLightsShineFromTheirFrontAlone) {
  const SceneFile file = read_text(kVertices + "ed 5\nf o x y\nsph z 0.1\n");
  EXPECT_EQ(file.scene.objects.at(0).sides, Sides::front);
  EXPECT_THAT(file.notes,
              ElementsAre(HasSubstr("1 light with emission (ed) from both sides: from the front")));
}

TEST(MgfContext, EverySurfaceCanShine) {
  for (const std::string entity :
       {"f o x y", "sph z 1", "cyl o 1 z", "ring z 1 2", "torus z 1 2", "prism o x y 1"}) {
    EXPECT_TRUE(only_object(kVertices + "sides 1\ned 5\n" + entity + "\n").emits()) << entity;
  }
}

TEST(MgfContext, ColoursOfMaterials) {
  expect_near(reflectance("cxy 0.333333 0.333333\nrd 0.7"), gray(0.7), 1e-5);
  expect_near(reflectance("cspec 380 780 1 1\nrd 0.7"), gray(0.7), 1e-4);
  // Half the luminance from each of two colours that are as far from grey on either side.
  expect_near(
      reflectance("c a =\ncxy 0.3 0.3\nc b =\ncxy 0.375 0.375\nc mix =\ncmix 1 a 1 b\nrd 0.6"),
      gray(0.6), 1e-9);
  // A mixture is by luminance: three parts of one colour.
  const Rgb mixed = reflectance("c a =\ncxy 0.4 0.4\nc n =\nc m =\ncmix 3 a 1 n\nrd 0.4");
  const Rgb pure = reflectance("c a =\ncxy 0.4 0.4\nrd 0.4");
  expect_near(mixed, pure * 0.75 + gray(0.4) * 0.25, 2e-3);
  EXPECT_NEAR(luminance(mixed), 0.4, 1e-12);
}

TEST(MgfContext, ColoursOutOfRangeArePaled) {
  const SceneFile file = read_text(kVertices + "cxy 0.73 0.26\nrd 0.5\nf o x y\n");
  const Rgb red = file.scene.material_of(0).reflectance;
  EXPECT_NEAR(luminance(red), 0.5, 1e-12);
  EXPECT_GT(red.r, 2 * red.g);
  EXPECT_LE(max_channel(red), 0.999);
  EXPECT_GE(min_channel(red), 0);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("mixed with grey")));
}

TEST(MgfContext, UnknownEntitiesAreNamedOnce) {
  const SceneFile file =
      read_text(kVertices + "mesh a b c\nmesh d\nlight 5\nf o x y\nies a.ies -s 2\n");
  EXPECT_THAT(file.notes,
              ElementsAre("1 luminaire in IES files (ies): not read, the light is missing",
                          "unknown entity 'light': ignored", "unknown entity 'mesh': ignored"));
  std::string many = kVertices + "f o x y\n";
  for (int i = 0; i < 1000; ++i) many += "entity" + std::to_string(i) + "\n";
  EXPECT_EQ(read_text(many).notes.size(), 21u);
}

TEST(MgfContext, LinesAreContinuedAndEndInAnyWay) {
  const std::string text =
      "\xef\xbb\xbf# a comment \\\nf that goes on\r\n\r#\n  v a = \r p 1 \\\r\n 2 \\\n\t3\nsph a "
      "\\\n0.5";
  const SceneFile file = read_text(text);
  EXPECT_EQ(file.scene.objects.at(0).shape->bounds().upper, (Vec3{1.5, 2.5, 3.5}));
}

}  // namespace
}  // namespace isolux
