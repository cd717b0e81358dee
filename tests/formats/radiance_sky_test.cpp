#include <gmock/gmock.h>

#include "formats/has_note.h"
#include "formats/radiance_sky_text.h"
#include "support/scenes.h"

namespace isolux {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// xform turns sun, zenith and hemispheres alike.
TEST(RadianceSky, XformTurnsTheSky) {
  const SceneFile plain = with_sky("!gensky -ang 40 25\n" + kDome);
  const std::string turned_dome = "skyfunc glow g 0 0 4 1 1 1 0\ng source all 0 0 4 0 1 0 360\n";
  const SceneFile turned = with_sky("!gensky -ang 40 25 | xform -rx -90 -ry 90\n" + turned_dome);
  const auto map = [](const Vec3& v) {  // z to y, then about y
    const Vec3 w{v.x, v.z, -v.y};
    return Vec3{w.z, w.y, -w.x};
  };
  const Sky &a = *plain.scene.sky, &b = *turned.scene.sky;
  expect_near(b.up, {0, 1, 0});
  expect_near(b.sun, map(a.sun));
  expect_near(turned.scene.sources.at(0).direction, map(plain.scene.sources.at(0).direction));
  EXPECT_LT(relative(b.zenith.g, a.zenith.g), 1e-12);
  EXPECT_LT(relative(b.ground.g, a.ground.g), 1e-12);
  // As xform writes it.
  const Sky written =
      dome("void brightfunc skyfunc 6 skybr skybright.cal -rz 90 -s 2 0 7 1 10 1 .5 0 -.6 .8");
  expect_near(written.sun, {0.6, 0, 0.8});
}

// gendaylit writes 1 + a exp(b / cos Z), 1 + c exp(d χ) + e cos² χ and an absolute factor.
TEST(RadianceSky, PerezSkies) {
  const std::string perez =
      "void brightfunc skyfunc 2 skybright /usr/lib/ray/perezlum.cal 0 "
      "10 2 3 -1 -.3 9 -3 .4 0 -.6 .8";
  const Sky sky = dome(perez);
  for (const double z : {0.0, 30.0, 75.0}) {
    const Vec3 d = toward(z, 40);
    const double chi = angle_between(d, {0, -0.6, 0.8}), cosine = std::cos(z * kDegree);
    const double radiance = 2 * (1 - std::exp(-0.3 / cosine)) *
                            (1 + 9 * std::exp(-3 * chi) + 0.4 * std::pow(std::cos(chi), 2));
    EXPECT_LT(relative(luminance(sky.luminance(d)), kEfficacy * radiance), 1e-12);
  }
  EXPECT_LT(relative(luminance(sky.ground), 3 * kEfficacy), 1e-12);
  const SceneFile colored = with_sky(
      "void colorfunc skyfunc 4 skybright_r skybright_g skybright_b perezlum_c.cal 0 "
      "22 2 3 -1 -.3 9 -3 .4 0 -.6 .8 5 1 1 1 1 1 1 1 1 1 1 1\n" +
      kDome);
  EXPECT_EQ(colored.scene.sky->zenith, sky.zenith);
  EXPECT_THAT(colored.notes, ElementsAre(HasSubstr("perezlum_c.cal")));
}

// Colors are those of the glows; half a sky may be plain.
TEST(RadianceSky, GlowsTintTheirHalf) {
  const Sky sky = with_sky(
                      "void brightfunc f 2 skybr skybright.cal 0 3 2 10 5\n"
                      "f glow above 0 0 4 .9 .9 1.2 0\nabove source sky 0 0 4 0 0 2 180\n"
                      "void light below 0 0 3 3 2 1\nbelow source ground 0 0 4 0 0 -1 180\n")
                      .scene.sky.value();
  EXPECT_NEAR(luminance(sky.zenith), 10 * kEfficacy * (0.265 * 0.9 + 0.67 * 0.9 + 0.065 * 1.2),
              1e-9);
  EXPECT_NEAR(sky.zenith.b / sky.zenith.r, 1.2 / 0.9, 1e-12);
  EXPECT_NEAR(luminance(sky.ground), kEfficacy * (0.265 * 3 + 0.67 * 2 + 0.065), 1e-9);
  EXPECT_NEAR(sky.ground.r / sky.ground.b, 3, 1e-12);
  const Sky plain =
      with_sky("void glow g 0 0 4 1 1 1 0\ng source s 0 0 4 0 1 0 180\n").scene.sky.value();
  expect_near(plain.up, {0, 1, 0});
  EXPECT_EQ(plain.distribution, standard_sky(5));
  EXPECT_NEAR(plain.zenith.g, kEfficacy, 1e-9);
  EXPECT_EQ(plain.ground.g, 0);
  // Down an axis lies the ground.
  const Sky ground =
      with_sky("void glow g 0 0 4 1 1 1 0\ng source s 0 0 4 0 -1 0 180\n").scene.sky.value();
  expect_near(ground.up, {0, 1, 0});
  EXPECT_EQ(ground.zenith.g, 0);
}

TEST(RadianceSky, PatternsAreFoundThroughOtherModifiers) {
  const std::string f = "void brightfunc f 2 skybr skybright.cal 0 3 3 10 5\n";
  const std::string all = " source s 0 0 4 0 0 1 360\n";
  for (const std::string& chain : {
           "f texfunc t 4 dx dy dz t.cal 0 0\nt glow g 0 0 4 1 1 1 0\ng" + all,
           "void glow g 0 0 4 1 1 1 0\ng alias h f\nh" + all,
           "f alias h f2\nvoid glow g 0 0 4 1 1 1 0\n" + f + "f alias h g\nh" + all,
           "f glow g 0 0 4 1 1 1 0\ninherit alias h g\nh" + all,
           "f glow g 0 0 4 1 1 1 0\n!echo 1\nnone" + all + "g" + all,
       }) {
    const SceneFile file = with_sky(f + chain);
    ASSERT_TRUE(file.scene.sky.has_value()) << chain;
    EXPECT_NEAR(luminance(file.scene.sky->zenith), 10 * kEfficacy, 1e-9) << chain;
    EXPECT_NEAR(luminance(file.scene.sky->ground), 5 * kEfficacy, 1e-9) << chain;
  }
}

TEST(RadianceSky, WhatIsNoSkyIsLeftOutWithANote) {
  const std::string f = "void brightfunc f 2 skybr skybright.cal 0 3 3 10 5\n";
  const std::string glow = "f glow g 0 0 4 1 1 1 0\n";
  const std::string picture = "void colorpict p 7 red green blue a.hdr a.cal u v 0 0\n";
  const std::pair<std::string, const char*> cases[] = {
      {f + glow + "g source s 0 0 4 0 0 1 120\n", "neither half (180) nor all (360)"},
      {f + glow + "g source s 0 0 4 0 1 1 180\n", "its horizon is not that of the sky"},
      {picture + "p glow g 0 0 4 1 1 1 0\ng source s 0 0 4 0 0 1 180\n", "its pattern is none of"},
      {picture + "p" + f.substr(4) + glow + "g source s 0 0 4 0 0 1 180\n", "its pattern is none"},
      {glow + "g source s 0 0 4 0 0 1 180\n", "its pattern is none of the skies"},
      {"void brightfunc f 2 skybr skybright.cal 0 3 7 1 1\n" + glow +
           "g source s 0 0 4 0 0 1 180\n",
       "its pattern is none of"},
      {"void brightfunc f 2 skybr skybright.cal 0 3 2 -1 1\n" + glow +
           "g source s 0 0 4 0 0 1 180\n",
       "darker than 0 in places"},
      {"void brightfunc f 2 skybright perezlum.cal 0 10 1 1 -9 -.3 1 -1 0 0 0 1\n" + glow +
           "g source s 0 0 4 0 0 1 180\n",
       "darker than 0 in places"},
      {"void brightfunc f 2 skybright perezlum.cal 0 10 1 1 1 1e9 1 1e9 0 0 0 1\n" + glow +
           "g source s 0 0 4 0 0 1 180\n",
       "darker than 0 in places, or not finite"},
      {"void glow g 0 0 4 1 1 1 -1\ng source s 0 0 4 0 0 1 180\n", "where it gives no light"},
  };
  for (const auto& [text, note] : cases) {
    const SceneFile file = with_sky(text);
    EXPECT_FALSE(file.scene.sky.has_value()) << text;
    EXPECT_TRUE(has_note(file, note)) << text << testing::PrintToString(file.notes);
  }
  const SceneFile two = with_sky(f + glow +
                                 "g source s 0 0 4 0 0 1 180\n"
                                 "void glow h 0 0 4 7 7 7 0\nh source t 0 0 4 0 0 1 180\n");
  EXPECT_NEAR(luminance(two.scene.sky->zenith), 10 * kEfficacy, 1e-9);
  EXPECT_THAT(two.notes, ElementsAre("'source' left out: a second sky over the first"));
}

// As windows are that shine in place of what is seen through them.
TEST(RadianceSky, SurfacesThatShineLikeTheSkyAreNoted) {
  const SceneFile file = with_sky(
      "!gensky -ang 30 0 -s\nskyfunc illum g 0 0 3 1 1 1\ng ring window 0 0 8 0 0 0 0 0 1 0 1\n");
  EXPECT_FALSE(file.scene.sky.has_value());
  EXPECT_TRUE(has_note(file, "they shine by their color alone"));
}

TEST(RadianceSky, WrongOnesAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"!gensky 13 1 12", ":13:9: expected a whole number from 1 to 12, not '13'"},
      {"!gensky 1 32 12", ":13:11: expected a whole number from 1 to 31"},
      {"!gensky 1 1", ":13:2: 'gensky' lacks an argument: write gensky month day hour"},
      {"!gensky 1 1 noon", ":13:13: expected a time such as 13:30"},
      {"!gensky 1 1 12:70", ":13:13: expected a time such as 13:30"},
      {"!gensky 1 1 25", ":13:13: the hour must lie between 0 and 24"},
      {"!gensky 1 1 +12EST", ":13:13: expected a time such as"},
      {"!gensky 1 1 12EXT", ":13:13: unknown time zone 'EXT'"},
      {"!gensky 1 1 nan", ":13:13: expected a time such as"},
      {"!gensky -ang 99 0", ":13:14: must lie between -90 and 90, but is 99"},
      {"!gensky -ang 30 0 -g", ":13:19: '-g' needs a number"},
      {"!gensky -ang 30 0 -g 2", ":13:22: must lie between 0 and 1, but is 2"},
      {"!gensky -ang 30 0 -b -1", ":13:22: must not be negative"},
      {"!gensky -ang 30 0 -t 1e300", ":13:2: this sky would be brighter than"},
      {"!gensky -ang 30 0 -r 1e30", ":13:2: this sky would be brighter than"},
      {"!gensky 1 1 12 -y 1850", ":13:19: expected a whole number from 1901 to 2099"},
      {"void brightfunc f 2 skybr skybright.cal 0 3 1 10 5", ":13:43: 'brightfunc' takes other"},
      {"void brightfunc f 2 skybr skybright.cal 0 7 1 1 1 1 0 0 0", ":13:53: the direction"},
      {"void brightfunc f 3 skybr skybright.cal x 0 3 2 1 1", ":13:41: 'x' is no transform"},
      {"void brightfunc f 2 skybr skybright.cal 0 3 2 1e12 1\nf glow g 0 0 4 1 1 1 0\n"
       "g source s 0 0 4 0 0 1 180",
       ":15:1: this sky would be brighter than"},
  };
  for (const auto& [text, message] : cases) {
    EXPECT_THAT(radiance_refusal("\n\n\n\n\n\n" + kThing + text + std::string("\n")),
                HasSubstr(message))
        << text;
  }
  EXPECT_THAT(with_sky("!gensky 1 1 12 -x 3\n").notes,
              ElementsAre("command 'gensky' left out: the option '-x' is not known"));
}

// Radiance's own scene of an office in Berkeley, in December.
TEST(RadianceSky, TheOfficeOfTheRadianceScenes) {
  ISOLUX_NEED_SCENES();
  const auto folder = shared_dir() / "scenes/radiance-obj";
  const SceneFile file = read_radiance(folder / "virtual/plain.rif");
  const Sky& sky = file.scene.sky.value();
  ASSERT_EQ(file.scene.sources.size(), 1u);
  expect_near(file.scene.sources[0].direction, {0.248504, 0.846738, -0.470404}, 2e-6);
  expect_near(sky.up, {0, 0, 1});
  expect_near(sky.sun, -file.scene.sources[0].direction);
  EXPECT_EQ(sky.distribution, standard_sky(12));
  const double tint = 0.265 * 0.9 + 0.67 * 0.9 + 0.065 * 1.2;
  EXPECT_LT(relative(luminance(sky.zenith), 5.97153 * tint * kEfficacy), 1e-3);
  EXPECT_NEAR(sky.zenith.b / sky.zenith.g, 1.2 / 0.9, 1e-12);
  const double soil = 0.265 * 1.2 + 0.67 + 0.065 * 0.7;
  EXPECT_LT(relative(luminance(sky.ground), 13.29946 * soil * kEfficacy), 1e-6);
  EXPECT_TRUE(file.scene.has_light());
  // The other office has its y axis up.
  const SceneFile day = read_radiance(folder / "office/officeday.rif");
  expect_near(day.scene.sky.value().up, {0, 1, 0}, 1e-12);
  EXPECT_GT(day.scene.sky->ground.g, 0);
}

}  // namespace
}  // namespace isolux
