#include <gmock/gmock.h>

#include <numbers>

#include "formats/radiance_text.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A ball with the material "a" of the text.
SceneFile ball_of(const std::string& materials) {
  return read_radiance_text(materials + "\na sphere ball\n0\n0\n4 0 0 0 1\n");
}

Rgb reflectance_of(const std::string& materials) {
  return ball_of(materials).scene.material_of(0).reflectance;
}

void expect_near(const Rgb& a, const Rgb& b) {
  EXPECT_NEAR(a.r, b.r, 1e-12);
  EXPECT_NEAR(a.g, b.g, 1e-12);
  EXPECT_NEAR(a.b, b.b, 1e-12);
}

TEST(RadianceMaterial, TheDiffusePartIsKept) {
  EXPECT_THAT(ball_of("void plastic a 0 0 5 .5 .4 .2 0 .1").notes, IsEmpty());
  expect_near(reflectance_of("void plastic a 0 0 5 .5 .4 .2 0 .1"), {0.5, 0.4, 0.2});
  expect_near(reflectance_of("void plastic a 0 0 5 .5 .4 .2 .25 .1"), {0.375, 0.3, 0.15});
  expect_near(reflectance_of("void metal a 0 0 5 .5 .4 .2 .9 .1"), {0.05, 0.04, 0.02});
  expect_near(reflectance_of("void metal2 a 4 1 0 0 . 0 6 .5 .4 .2 .5 .1 .1"), {0.25, 0.2, 0.1});
  expect_near(reflectance_of("void trans a 0 0 7 .5 .4 .2 .1 0 .5 .3"), {0.225, 0.18, 0.09});
  expect_near(reflectance_of("void trans2 a 4 1 0 0 . 0 8 .5 .4 .2 .1 0 0 .5 .3"),
              {0.225, 0.18, 0.09});
  expect_near(reflectance_of("void transfunc a 2 f f.cal 0 6 .5 .4 .2 .1 .5 .3"),
              {0.225, 0.18, 0.09});
  expect_near(reflectance_of("void plasfunc a 2 f f.cal 0 4 .5 .4 .2 .5"), {0.25, 0.2, 0.1});
  expect_near(reflectance_of("void BRTDfunc a 10 0 0 0 0 0 0 0 0 0 . 0 9 .3 .2 .1 1 1 1 0 0 0"),
              {0.3, 0.2, 0.1});
  EXPECT_THAT(ball_of("void metal a 0 0 5 .5 .4 .2 .9 .1").notes,
              ElementsAre(HasSubstr("'metal': its gloss is absorbed")));
  EXPECT_THAT(ball_of("void trans a 0 0 7 .5 .4 .2 .1 0 .5 .3").notes,
              ElementsAre(HasSubstr("'trans': nothing shines through")));
}

TEST(RadianceMaterial, ReflectancesStayBelow1) {
  const SceneFile file = ball_of("void plastic a 0 0 5 1 1.5 .2 0 0");
  expect_near(file.scene.material_of(0).reflectance, {0.999, 0.999, 0.2});
  EXPECT_THAT(file.notes, ElementsAre("reflectance of 1 or more: reduced to 0.999"));
}

// A white light of radiance 1: pi lm/(W sr) · 179 lm/W. Colored ones have the luminance that
// Radiance's own weights give, and keep the proportions of their channels.
TEST(RadianceMaterial, LightIsInLumens) {
  const auto exitance = [](const std::string& materials) {
    return ball_of(materials).scene.objects[0].exitance;
  };
  expect_near(exitance("void light a 0 0 3 1 1 1"), gray(179 * pi));
  const Rgb colored = exitance("void light a 0 0 3 4 2 1");
  EXPECT_NEAR(luminance(colored), 179 * pi * (0.265 * 4 + 0.670 * 2 + 0.065 * 1), 1e-9);
  EXPECT_NEAR(colored.r / colored.g, 2, 1e-12);
  EXPECT_NEAR(colored.g / colored.b, 2, 1e-12);
  EXPECT_NEAR(luminance(exitance("void light a 0 0 3 0 0 1")), 179 * pi * 0.065, 1e-9);
  expect_near(exitance("void glow a 0 0 4 1 1 1 0"), gray(179 * pi));
  expect_near(exitance("void glow a 0 0 4 1 1 1 -1"), {});
  expect_near(exitance("void illum a 1 void 0 3 1 1 1"), gray(179 * pi));
  // All that a cone of 60 degrees lets out: sin² 30° of it.
  expect_near(exitance("void spotlight a 0 0 7 1 1 1 60 0 0 1"), gray(179 * pi / 4));
  expect_near(exitance("void light a 0 0 3 0 0 0"), {});
  const SceneFile lamp = ball_of("void light a 0 0 3 1 1 1");
  EXPECT_EQ(lamp.scene.material_of(0).name, "a");
  expect_near(lamp.scene.material_of(0).reflectance, {});
  EXPECT_THAT(lamp.notes, IsEmpty());
}

TEST(RadianceMaterial, WhatIsClearIsLeftOut) {
  for (const std::string clear :
       {"void glass a 0 0 3 .9 .9 .9", "void dielectric a 0 0 5 1 1 1 1.5 0",
        "void interface a 0 0 8 1 1 1 1.5 1 1 1 1.3", "void antimatter a 1 b 0 0",
        "void mist a 0 0 0"}) {
    const SceneFile file = read_radiance_text(clear + "\na sphere pane 0 0 4 0 0 0 1\n" + kGray +
                                              "m sphere ball 0 0 4 0 0 0 1\n");
    ASSERT_EQ(file.scene.objects.size(), 1u) << clear;
    EXPECT_EQ(file.scene.objects[0].name, "ball");
    EXPECT_THAT(file.notes, ElementsAre(HasSubstr("light passes unhindered"))) << clear;
  }
}

TEST(RadianceMaterial, MirrorsAreBlackOrTheirOtherMaterial) {
  expect_near(reflectance_of("void mirror a 0 0 3 .9 .9 .9"), {});
  expect_near(reflectance_of("void plastic b 0 0 5 .2 .3 .4 0 0\nvoid mirror a 1 b 0 3 .9 .9 .9"),
              {0.2, 0.3, 0.4});
}

TEST(RadianceMaterial, PatternsAndTexturesAreLookedThrough) {
  const std::string blue = "void plastic blue 0 0 5 .1 .2 .5 0 0\n";
  // Behind the material they don't matter; before it, the chain goes on to it.
  expect_near(
      reflectance_of("void brightfunc grain 2 g w.cal 0 0\ngrain plastic a 0 0 5 .1 .2 .5 0 0"),
      {0.1, 0.2, 0.5});
  const SceneFile file = ball_of(blue +
                                 "blue brightfunc p 2 g w.cal 0 0\np texfunc t 4 x y z t.cal 0 "
                                 "0\nt colorpict a 7 r g b p.hdr . u v 0 0");
  expect_near(file.scene.material_of(0).reflectance, {0.1, 0.2, 0.5});
  EXPECT_EQ(file.scene.material_of(0).name, "blue");
  EXPECT_THAT(file.notes,
              ElementsAre("'colorpict' and 'brightfunc': surfaces have the plain color of "
                          "their material",
                          HasSubstr("'texfunc'")));
}

TEST(RadianceMaterial, MixturesAreTheirForeground) {
  const std::string both =
      "void plastic fore 0 0 5 .1 .1 .1 0 0\nvoid plastic back 0 0 5 .2 .2 .2 0 0\n";
  expect_near(reflectance_of(both + "void mixfunc a 4 fore back f . 0 0"), gray(0.1));
  expect_near(reflectance_of(both + "void mixfunc a 4 void back f . 0 0"), gray(0.2));
  // One of patterns leaves the material to the modifier behind it.
  expect_near(reflectance_of(
                  both + "void brightfunc p 2 f . 0 0\nback mixpict a 7 p void g x.hdr . u v 0 0"),
              gray(0.2));
}

TEST(RadianceMaterial, Aliases) {
  const std::string blue = "void plastic blue 0 0 5 .1 .2 .5 0 0\n";
  const Scene scene = ball_of(blue + "void alias a blue").scene;
  expect_near(scene.material_of(0).reflectance, {0.1, 0.2, 0.5});
  EXPECT_EQ(scene.material_of(0).name, "a");
  expect_near(reflectance_of(blue + "void brightfunc p 2 f . 0 0\nblue alias a p"),
              {0.1, 0.2, 0.5});
}

TEST(RadianceMaterial, NamesMeanTheLastOneOfThatName) {
  const Scene scene = read_radiance_text(
                          "void plastic a 0 0 5 .1 .1 .1 0 0\na sphere s 0 0 4 0 0 0 1\n"
                          "void plastic a 0 0 5 .2 .2 .2 0 0\na sphere s 0 0 4 9 0 0 1\n"
                          "void plastic b 0 0 5 .3 .3 .3 0 0\n")
                          .scene;
  expect_near(scene.material_of(0).reflectance, gray(0.1));
  expect_near(scene.material_of(1).reflectance, gray(0.2));
  ASSERT_EQ(scene.materials.size(), 2u) << "only those that surfaces have";
  EXPECT_EQ(scene.materials[1].name, "a 2");
  EXPECT_EQ(scene.objects[1].name, "s 2");
}

TEST(RadianceMaterial, UndefinedOnesAreGrayAndVoidIsNothing) {
  const SceneFile file = ball_of("");
  expect_near(file.scene.material_of(0).reflectance, gray(0.5));
  EXPECT_THAT(file.notes, ElementsAre("undefined 'a': surfaces have a reflectance of 0.5"));
  const SceneFile empty =
      read_radiance_text(kGray + "void sphere s 0 0 4 0 0 0 1\nm sphere t 0 0 4 0 0 0 1\n");
  EXPECT_EQ(empty.scene.objects.size(), 1u);
  EXPECT_THAT(empty.notes, ElementsAre(HasSubstr("'void': surfaces without a material")));
}

}  // namespace
}  // namespace isolux
