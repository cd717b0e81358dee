#include "isolux/scene/sky.h"

#include <gmock/gmock.h>

#include <array>
#include <numbers>

#include "scene/scene_text.h"

namespace isolux {
namespace {

using testing::HasSubstr;
constexpr double kPi = std::numbers::pi;

/// Cosines of the sun's angle from the zenith.
constexpr std::array kSuns{1.0, 0.9998, 0.97, 0.7, 0.2, 0.02, 0.0};

Sky sky_with(const SkyDistribution& distribution, double cos_sun) {
  Sky sky;
  sky.distribution = distribution;
  sky.sun = {std::sqrt(1 - cos_sun * cos_sun), 0, cos_sun};
  sky.zenith = gray(1);
  return sky;
}

/// ∫ L cos Z dω over sin² Z and the azimuth: the disk on which Nusselt's analogue has the sky.
double illuminance_on_disk(const Sky& sky, int steps) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double squared = (i + 0.5) / steps;
    const double sine = std::sqrt(squared), cosine = std::sqrt(1 - squared);
    for (int j = 0; j < steps; ++j) {
      const double azimuth = kPi * (j + 0.5) / steps;
      sum += sky.relative_luminance({sine * std::cos(azimuth), sine * std::sin(azimuth), cosine});
    }
  }
  return kPi * sum / (double(steps) * steps);
}

TEST(Sky, UniformAndOvercastHaveTheirClosedForms) {
  for (const double cos_sun : {1.0, 0.9998, 0.7, 0.02, 0.0, -0.02, -0.7, -1.0}) {
    EXPECT_NEAR(horizontal_illuminance(standard_sky(5), cos_sun), kPi, 2e-5 * kPi);
    EXPECT_NEAR(horizontal_illuminance(standard_sky(16), cos_sun), kPi * 7 / 9, 2e-5 * kPi);
  }
}

TEST(Sky, HorizontalIlluminanceIsTheIntegralOfTheLuminance) {
  for (int type = 1; type <= kSkyTypes; ++type) {
    for (const double cos_sun : kSuns) {
      const double expected = illuminance_on_disk(sky_with(standard_sky(type), cos_sun), 512);
      EXPECT_NEAR(horizontal_illuminance(standard_sky(type), cos_sun) / expected, 1, 1e-4)
          << "type " << type << ", " << cos_sun;
    }
  }
}

TEST(Sky, NarrowAureolesCount) {
  // As narrow as a reader takes them, L = f: its integral in closed form where the sun is in the
  // zenith, with sin χ cos χ = sin(2 χ) / 2.
  const SkyDistribution narrow{0, -1, 100, -100, 0};
  const double d = narrow.d, end = std::exp(d * kPi / 2);
  const double peak = (1 + end) / (d * d + 4);  // ∫ exp(d χ) sin(2 χ) / 2 dχ from 0 to π/2
  const double expected = 2 * kPi * (0.5 * (1 - narrow.c * end) + narrow.c * peak);
  EXPECT_NEAR(horizontal_illuminance(narrow, 1) * narrow.indicatrix(1) / expected, 1, 1e-4);
}

TEST(Sky, TheZenithIsTheMeasure) {
  for (int type = 1; type <= kSkyTypes; ++type) {
    for (const double cos_sun : kSuns) {
      const Sky sky = sky_with(standard_sky(type), cos_sun);
      EXPECT_NEAR(sky.relative_luminance({0, 0, 1}), 1, 1e-12) << type;
      EXPECT_EQ(sky.luminance({0, 0.6, -0.8}), Rgb{}) << "the ground is black";
    }
  }
}

// What CIE S 011 says in words of its table.
TEST(Sky, StandardSkiesAreAsTheirNamesSay) {
  const auto at = [](int type, double cos_sun, const Vec3& direction) {
    return sky_with(standard_sky(type), cos_sun).relative_luminance(direction);
  };
  const Vec3 horizon{0, 1, 0}, towards{0.8, 0, 0.6}, away{-0.8, 0, 0.6};
  // 1: the overcast sky, about three times brighter in the zenith than at the horizon, the same all
  // around; 16, whose formula is simpler, has that ratio exactly.
  EXPECT_NEAR(at(1, 0.6, horizon), 1 / (1 + 4 * std::exp(-0.7)), 1e-9);
  EXPECT_NEAR(at(1, 0.6, horizon), 1.0 / 3, 0.01);
  EXPECT_NEAR(at(16, 0.6, horizon), 1.0 / 3, 1e-12);
  for (const int type : {1, 3, 5, 16}) {
    EXPECT_FALSE(standard_sky(type).depends_on_sun());
    EXPECT_NEAR(at(type, 0.6, towards), at(type, 0.6, away), 1e-12);
  }
  EXPECT_EQ(at(5, 0.3, horizon), 1);
  EXPECT_EQ(at(5, 0.3, towards), 1);
  for (const int type : {2, 4, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}) {
    EXPECT_TRUE(standard_sky(type).depends_on_sun());
    EXPECT_GT(at(type, 0.6, towards), at(type, 0.6, away)) << type;
  }
  // The later of them have brighter horizons, and aureoles that stand out more.
  for (const int type : {12, 13, 14, 15}) EXPECT_GT(at(type, 1, horizon), at(11, 1, horizon));
  EXPECT_GT(at(15, 0.6, towards), at(13, 0.6, towards));
}

TEST(Sky, RangeHoldsEveryDirection) {
  for (int type = 1; type <= kSkyTypes; ++type) {
    for (const double cos_sun : kSuns) {
      const Sky sky = sky_with(standard_sky(type), cos_sun);
      const LuminanceRange range = relative_range(sky.distribution, cos_sun);
      EXPECT_GT(range.least, 0) << type;
      EXPECT_LT(range.most, 1e4) << type;
      for (int i = 0; i < 1000; ++i) {
        const double z = (i + 0.5) / 1000, azimuth = 2.4 * i, s = std::sqrt(1 - z * z);
        const double part =
            sky.relative_luminance({s * std::cos(azimuth), s * std::sin(azimuth), z});
        EXPECT_GE(part, range.least * (1 - 1e-3));
        EXPECT_LE(part, range.most * (1 + 1e-3));
      }
      EXPECT_LE(sky.relative_luminance(sky.sun), range.most * (1 + 1e-12));
    }
  }
}

std::string scene_with(const std::string& sky) {
  return scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n") + "sky: " + sky + "\n";
}

Sky read_sky(const std::string& sky) { return *read_scene(scene_with(sky), "test.yaml").sky; }

TEST(SkyReader, OvercastSkyOfAnIlluminance) {
  const Sky sky = read_sky("{type: overcast, illuminance: 7000}");
  EXPECT_EQ(sky.distribution, standard_sky(16));
  EXPECT_EQ(sky.up, (Vec3{0, 0, 1}));
  EXPECT_NEAR(sky.zenith.r, 9000 / kPi, 0.1);
  EXPECT_EQ(sky.zenith, gray(sky.zenith.g));
  EXPECT_EQ(sky.ground, Rgb{});
  EXPECT_NEAR(luminance(horizontal_illuminance(sky)), 7000, 1e-9);
  EXPECT_TRUE(sky.shines());
  EXPECT_TRUE(read_scene(scene_with("{type: overcast, zenith: 1}"), "test.yaml").has_light());
  EXPECT_FALSE(read_scene(scene_with("{type: overcast, zenith: 0}"), "test.yaml").has_light());
}

TEST(SkyReader, ClearSkyWithAllThatItMayHave) {
  const Sky sky = read_sky(
      "{type: clear, sun: [0, -3, 3], illuminance: 12000, color: [0.9, 1, 1.2], ground: [300, 200, "
      "100], up: [0, 0, 2]}");
  EXPECT_EQ(sky.distribution, standard_sky(12));
  expect_near(sky.sun, {0, -std::sqrt(0.5), std::sqrt(0.5)});
  expect_near(sky.up, {0, 0, 1});
  EXPECT_NEAR(luminance(horizontal_illuminance(sky)), 12000, 1e-8);
  EXPECT_NEAR(sky.zenith.b / sky.zenith.r, 1.2 / 0.9, 1e-12);
  EXPECT_EQ(sky.ground, (Rgb{300, 200, 100}));
  EXPECT_EQ(sky.luminance({0, 0.6, -0.8}), sky.ground);
}

TEST(SkyReader, TypesByNumberAndByCoefficients) {
  for (int type = 1; type <= kSkyTypes; ++type) {
    EXPECT_EQ(read_sky("{type: " + std::to_string(type) + ", sun: z, zenith: 1}").distribution,
              standard_sky(type));
  }
  EXPECT_EQ(read_sky("{type: uniform, zenith: 1}").distribution, standard_sky(5));
  const Sky sky = read_sky("{distribution: [-1, -0.32, 10, -3, 0.45], sun: x, zenith: [1, 2, 3]}");
  EXPECT_EQ(sky.distribution, standard_sky(12));
  EXPECT_EQ(sky.sun, (Vec3{1, 0, 0}));
  EXPECT_EQ(sky.zenith, (Rgb{1, 2, 3}));
}

TEST(SkyReader, TheZenithMayBeElsewhere) {
  // The sun matters to no overcast sky, wherever it is.
  const Sky sky = read_sky("{type: overcast, up: y, illuminance: 7000, sun: [0, -1, 0]}");
  EXPECT_EQ(sky.up, (Vec3{0, 1, 0}));
  EXPECT_NEAR(sky.luminance({0, 1, 0}).r, 9000 / kPi, 0.1);
  EXPECT_NEAR(sky.luminance({0, 1e-9, 1}).r, 3000 / kPi, 0.1);
  EXPECT_EQ(read_sky("{type: 1, up: y, zenith: 1}").sun, (Vec3{0, 1, 0}));
}

TEST(SkyReader, FaultsNameTheirPlace) {
  const auto fault = [](const std::string& sky) { return refusal(scene_with(sky)); };
  EXPECT_THAT(fault("{zenith: 1}"), HasSubstr("one of 'type', such as overcast, and"));
  EXPECT_THAT(fault("{type: 1, distribution: [0, -1, 0, -1, 0], zenith: 1}"),
              HasSubstr("one of 'type'"));
  EXPECT_THAT(fault("{type: 1}"), HasSubstr("one of 'illuminance' (lx) and 'zenith'"));
  EXPECT_THAT(fault("{type: 1, zenith: 1, illuminance: 1}"), HasSubstr("one of 'illuminance'"));
  EXPECT_THAT(fault("{type: 0, zenith: 1}"), HasSubstr("a whole number from 1 to 16, not '0'"));
  EXPECT_THAT(fault("{type: clera, zenith: 1}"), HasSubstr("did you mean 'clear'?"));
  EXPECT_THAT(fault("{type: clear, zenith: 1}"), HasSubstr("lacks the key 'sun'"));
  EXPECT_EQ(fault("{type: clear, sun: [1, 0, -0.01], zenith: 1}"), "");
  EXPECT_THAT(fault("{distribution: [-1, -1e-15, 0, 0, 0], zenith: 1}"), HasSubstr("500 times"));
  EXPECT_THAT(fault("{type: 1, zenith: 1e-300}"), HasSubstr("less than 1e-9"));
  EXPECT_EQ(fault("{type: clear, sun: [1, 1, 0], up: [1, -1, 0.3], zenith: 1}"), "");
  EXPECT_THAT(fault("{type: 1, zenith: -1}"), HasSubstr("'zenith' must not be negative"));
  EXPECT_THAT(fault("{type: 1, zenith: .nan}"), HasSubstr("must be a finite number"));
  EXPECT_THAT(fault("{type: 1, zenith: [1, 1, 1], color: 1}"), HasSubstr("remove 'color'"));
  EXPECT_THAT(fault("{type: 1, zenith: 1, color: 0}"), HasSubstr("must not be black"));
  EXPECT_THAT(fault("{type: 1, zenith: 1, up: [0, 0, 0]}"), HasSubstr("must not be [0, 0, 0]"));
  EXPECT_THAT(fault("{type: 1, zenith: 1, ground: 1e10}"), HasSubstr("'ground' is brighter"));
  EXPECT_THAT(fault("{type: 1, zenith: 1.1e9}"), HasSubstr("brighter than 1e9 cd/m2"));
  EXPECT_THAT(fault("{type: 15, sun: z, zenith: 9e8}"), HasSubstr("brighter than 1e9 cd/m2"));
  EXPECT_THAT(fault("{type: 1, illuminance: 1e300}"), HasSubstr("brighter than 1e9 cd/m2"));
}

TEST(SkyReader, CoefficientsThatNoSkyHas) {
  const auto fault = [](const std::string& numbers, const std::string& sun = "z") {
    return refusal(scene_with("{distribution: [" + numbers + "], sun: " + sun + ", zenith: 1}"));
  };
  EXPECT_EQ(fault("4, -0.7, 2, -1.5, 0.15"), "");
  EXPECT_THAT(fault("4, -0.7, 2, -1.5"), HasSubstr("must be a list of 5, not of 4"));
  EXPECT_THAT(fault("4, -0.7, 2, -1.5, 101"), HasSubstr("lie within 100"));
  EXPECT_THAT(fault("4, -0.7, 2, -1e308, 0"), HasSubstr("lie within 100"));
  EXPECT_THAT(fault("4, 0.1, 2, -1.5, 0"), HasSubstr("b, must not be more than 0"));
  EXPECT_THAT(fault("-1, 0, 2, -1.5, 0"), HasSubstr("the zenith of this sky has no luminance"));
  EXPECT_THAT(fault("-2, -0.1, 0, -1, 0"), HasSubstr("directions of negative luminance"));
  EXPECT_THAT(fault("0, -1, -2, -1, 0", "x"), HasSubstr("directions of negative luminance"));
  // Dark around a sun at the horizon, and nowhere else.
  EXPECT_THAT(fault("0, -1, -1.1, -100, 0", "x"), HasSubstr("directions of negative luminance"));
}

}  // namespace
}  // namespace isolux
