#include <fmt/format.h>
#include <gmock/gmock.h>

#include "formats/has_note.h"
#include "formats/radiance_sky_text.h"

namespace isolux {
namespace {

using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;

// What gensky wrote for 21 March, noon, in Berkeley, as OpenStudio ships it (03211200_clr.sky), in
// three digits: the sun's direction gives the solar angles, all else follows from them.
TEST(RadianceGensky, GenskyWritesWhatItHasWritten) {
  const Vec3 sun{0.067845, -0.617210, 0.783868};
  const double altitude = std::asin(sun.z) / kDegree;
  const double azimuth = std::atan2(-sun.x, -sun.y) / kDegree;
  const SceneFile file = with_sky(fmt::format("!gensky -ang {} {}\n", altitude, azimuth) + kDome);
  ASSERT_EQ(file.scene.sources.size(), 1u);
  const Source& light = file.scene.sources[0];
  expect_near(light.direction, -sun, 1e-6);
  EXPECT_EQ(light.name, "sun");
  EXPECT_LT(relative(luminance(light.intensity), 6.92e6 * kEfficacy * kSunAngle), 1e-3);
  const Sky written = dome(
      "void brightfunc skyfunc 2 skybr skybright.cal 0 "
      "7 1 1.16e+01 2.37e+01 6.92e-01 0.067845 -0.617210 0.783868");
  const Sky& sky = file.scene.sky.value();
  EXPECT_LT(relative(sky.zenith.g, written.zenith.g), 3e-3);
  EXPECT_LT(relative(sky.ground.g, written.ground.g), 3e-3);
  EXPECT_LT(relative(luminance(written.ground), 23.7 * kEfficacy), 1e-12);
  EXPECT_EQ(sky.distribution, written.distribution);
  expect_near(sky.sun, sun, 1e-6);
  expect_near(sky.up, {0, 0, 1});
}

// And for 16 March, 10:00, in Perth: a file of the days when the turbidity was 2.75 without -t.
TEST(RadianceGensky, TheSunIsFainterNearTheHorizon) {
  const double altitude = std::asin(0.190903) / kDegree;
  const SceneFile file = with_sky(fmt::format("!gensky -ang {} 0 +s -t 2.75\n", altitude) + kDome);
  EXPECT_LT(relative(luminance(file.scene.sources.at(0).intensity), 2.72e6 * kEfficacy * kSunAngle),
            2e-3);
  const Sky written =
      dome("void brightfunc skyfunc 2 skybr skybright.cal 0 7 1 3.76 3.72 .298 0 -.981609 .190903");
  EXPECT_LT(relative(file.scene.sky->zenith.g, written.zenith.g), 3e-3);
  EXPECT_LT(relative(file.scene.sky->ground.g, written.ground.g), 3e-3);
}

// What it wrote for "gensky 3 20 10 -a 40 -o 98 -m 105" in a version whose declination had 368 days
// in the place of 365, and the angles of "gensky 7 4 14:30 +s": 57.0 and 73.1 degrees.
TEST(RadianceGensky, DatesItHasWritten) {
  const SceneFile march = with_sky("!gensky 3 20 10 -a 40 -o 98 -m 105 -g 1\n" + kDome);
  const Source& sun = march.scene.sources.at(0);
  expect_near(sun.direction, -Vec3{0.421409, -0.593560, 0.685639}, 3e-4);
  EXPECT_LT(relative(luminance(sun.intensity), 6.73e6 * kEfficacy * kSunAngle), 1e-3);
  // "Ground ambient level: 14.6", from the sky alone.
  const double by_sun = 6e-5 / pi * 6.73e6 * 0.685639;
  EXPECT_LT(relative(luminance(march.scene.sky->ground), (14.6 + by_sun) * kEfficacy), 1e-3);
  const SceneFile july = with_sky("!gensky 7 4 14:30 +s\n");
  EXPECT_LT(angle_between(-july.scene.sources.at(0).direction, toward(90 - 57.0, 73.1)),
            0.1 * kDegree);
}

// What daylight factors are reckoned from: 55.866 W/m² are 10,000 lx.
TEST(RadianceGensky, TenThousandLux) {
  const Sky sky = dome("!gensky 3 21 +12:00 -c -B 55.866");
  EXPECT_NEAR(luminance(sky.zenith) * horizontal_illuminance(sky.distribution, 1), 10'000, 1);
}

// By hand, from gensky(1) and the solar formulas of the IES Lighting Handbook: day 337, declination
// 0.4093 sin(2 π 256 / 365) = −0.39034; solar time 13 + 0.170 sin(4 π 257 / 373) − 0.129
// sin(2 π 329 / 355) + 12 / π (2.09440 − 2.13) = 13.0392 at the default site, 0.66 rad north and
// 2.13 rad west; altitude 28.0605°, azimuth 16.3561° west of south.
TEST(RadianceGensky, TheThirdOfDecember) {
  const SceneFile file = with_sky("!gensky 12 3 13 -g .2\n" + kDome);
  const Vec3 sun{-0.248504, -0.846738, 0.470404};
  expect_near(file.scene.sources.at(0).direction, -sun, 2e-6);
  // 1.5e9 / 208 (1.147 − 0.147 / 0.470404); (1.376 2.45 − 1.81) tan 28.0605° + 0.38 kcd/m² by
  // 203 lm/W; 0.2 (5.97153 2.08169 + 6e-5 / π 6.01805e6 0.470404).
  EXPECT_LT(relative(luminance(file.scene.sources[0].intensity),
                     6.018046e6 * kEfficacy * 2 * pi * (1 - std::cos(0.25 * kDegree))),
            1e-6);
  const Sky& sky = file.scene.sky.value();
  EXPECT_LT(relative(luminance(sky.ground), 13.29946 * kEfficacy), 1e-6);
  // The normalization of gensky is rounded to three digits: 0.274 for 1 − exp(−0.32).
  EXPECT_LT(relative(luminance(sky.zenith), 5.97153 * kEfficacy), 1e-3);
}

TEST(RadianceGensky, TimesAndPlaces) {
  const auto sun = [](const std::string& arguments) {
    return with_sky("!gensky " + arguments + "\n").scene.sources.at(0).direction;
  };
  expect_near(sun("12 3 13:30"), sun("12 3 13.5"));
  expect_near(sun("12 3 13:30est -o 80"), sun("12 3 13.5 -o 80 -m 75"));
  expect_near(sun("12 3 13EST -o 80 -m 0"), sun("12 3 13EST -o 80"));
  // At noon by the sun it is in the south, as high as the latitude leaves: 90° − 40° less the
  // declination. -o has no effect.
  const double declination = 0.4093 * std::sin(2 * pi / 365 * (337 - 81)) / kDegree;
  expect_near(sun("12 3 +12 -a 40 -o 77"), -toward(40 - declination, 0), 1e-9);
  expect_near(sun("12 3 +12 -a -60 "), -toward(60 + declination, 180), 1e-9);
  // In the afternoon it is in the west.
  EXPECT_GT(sun("12 3 +15").x, 0);
}

// The obliquity at the solstices, and the equinox of 2000; the approximation is good to 0.01°.
TEST(RadianceGensky, AYearAsksForTheAlmanac) {
  const auto altitude = [](const std::string& arguments) {
    const Vec3 d = with_sky("!gensky " + arguments + " +s\n").scene.sources.at(0).direction;
    return std::asin(-d.z) / kDegree;
  };
  EXPECT_NEAR(altitude("6 21 +12 -y 2000 -a 50"), 90 - 50 + 23.438, 0.02);
  EXPECT_NEAR(altitude("12 21 +12 -y 2000 -a 50"), 90 - 50 - 23.438, 0.02);
  // The equinox was on 20 March, 7:35 UT: on the equator the sun climbs 15° an hour.
  EXPECT_NEAR(altitude("3 20 +7.5833 -y 2000 -a 0 -o 0 -m 0"), 90 - 15 * (12 - 7.5833), 0.02);
  // By the clock: the equation of time is +16.4 minutes on 3 November, at noon of Greenwich.
  const Vec3 d = with_sky("!gensky 11 3 12 -y 2000 -a 0 -o 0 -m 0\n").scene.sources.at(0).direction;
  const double hour_angle = std::atan2(d.x, -d.z) / 15 / kDegree * 60;  // minutes
  EXPECT_NEAR(hour_angle, 16.4, 0.1);
}

// Radiance's clear sky (skybright.cal) is type 12 of the CIE: L = zenith (0.91 + 10 exp(−3 χ) +
// 0.45 cos² χ) (1 − exp(−0.32 / cos Z)) / 0.274 (0.91 + 10 exp(−3 Z_s) + 0.45 cos² Z_s).
TEST(RadianceGensky, TheClearSkyIsTypeTwelve) {
  const Sky sky = dome("!gensky -ang 35 20 -s -b 10");
  EXPECT_EQ(sky.distribution, standard_sky(12));
  EXPECT_TRUE(with_sky("!gensky -ang 35 20 -s\n").scene.sources.empty());
  const Vec3 sun = toward(55, 20);
  const auto function = [](double chi) {
    return 0.91 + 10 * std::exp(-3 * chi) + 0.45 * std::pow(std::cos(chi), 2);
  };
  for (const double z : {0.0, 20.0, 50.0, 80.0, 89.0}) {
    for (const double azimuth : {20.0, 70.0, 200.0, 300.0}) {
      const Vec3 d = toward(z, azimuth);
      const double radiance = 10 * function(angle_between(d, sun)) *
                              (1 - std::exp(-0.32 / std::cos(z * kDegree))) /
                              (0.274 * function(55 * kDegree));
      EXPECT_LT(relative(luminance(sky.luminance(d)), kEfficacy * radiance), 1e-3);
    }
  }
}

TEST(RadianceGensky, TheOvercastSkyIsTypeSixteen) {
  const Sky sky = dome("!gensky -ang 30 0 -c -g .3");
  EXPECT_EQ(sky.distribution, standard_sky(16));
  const double zenith = (8.6 * 0.5 + 0.123) * 1000 / 203 * kEfficacy;
  EXPECT_LT(relative(luminance(sky.zenith), zenith), 1e-9);
  EXPECT_LT(relative(luminance(sky.ground), 0.3 * 7 / 9 * zenith), 1e-9);
  EXPECT_LT(relative(luminance(sky.luminance(toward(60, 7))), zenith * 2 / 3), 1e-9);
  EXPECT_TRUE(with_sky("!gensky -ang 30 0 -c\n").scene.sources.empty());
}

// The illuminance of the open ground; where there is a sun, gensky has polynomials for it.
TEST(RadianceGensky, SkiesHaveTheIrradianceThatIsAskedFor) {
  for (const auto& [option, off] :
       {std::pair{"-s", 0.02}, std::pair{"-i", 0.05}, std::pair{"-c", 1e-4}, {"-u", 1e-9}}) {
    for (const double altitude : {15.0, 40.0, 65.0}) {
      const Sky sky = dome(fmt::format("!gensky -ang {} 30 {} -B 100", altitude, option));
      const double illuminance =
          luminance(sky.zenith) * horizontal_illuminance(sky.distribution, dot(sky.sun, sky.up));
      // Where there is a sun gensky has polynomials for the integral.
      EXPECT_LT(relative(illuminance, 100 * kEfficacy), std::max(off, 2e-5)) << option << altitude;
    }
  }
}

TEST(RadianceGensky, SunsHaveTheStrengthThatIsAskedFor) {
  const auto sun = [](const std::string& arguments) {
    const auto& sources = with_sky("!gensky -ang 30 0 " + arguments + "\n").scene.sources;
    return sources.empty() ? 0 : luminance(sources[0].intensity) / kEfficacy;
  };
  EXPECT_LT(relative(sun("+s -R 200"), 400), 1e-3);  // horizontal: across the light twice that
  EXPECT_LT(relative(sun("+i -r 1e6"), 1e6 * kSunAngle), 1e-3);
  EXPECT_LT(relative(sun("+i"), 0.15 * sun("+s")), 1e-9);
  EXPECT_EQ(sun("+s -r 0"), 0);
  EXPECT_EQ(sun("-i"), 0);
  EXPECT_TRUE(with_sky("!gensky -ang -5 0 +s\n").scene.sources.empty()) << "it has set";
}

TEST(RadianceGensky, TheIntermediateSkyIsTheNearestOfTheCie) {
  const SceneFile file = with_sky("!gensky -ang 40 0 -i\n" + kDome);
  ASSERT_TRUE(has_note(file, "the intermediate sky: the CIE sky of type"));
  const Sky& sky = file.scene.sky.value();
  EXPECT_EQ(sky.distribution.slope, 0);
  EXPECT_NE(sky.distribution, standard_sky(5));
}

TEST(RadianceGensky, ASunInTheZenithIsLowered) {
  const SceneFile file = with_sky("!gensky -ang 89 0\n" + kDome);
  expect_near(file.scene.sources.at(0).direction, -toward(3, 0), 1e-12);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("lowered to 87 degrees")));
}

}  // namespace
}  // namespace isolux
