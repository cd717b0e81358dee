#include "isolux/scene/source.h"

#include <gmock/gmock.h>

#include <numbers>

#include "scene/scene_text.h"

namespace isolux {
namespace {

constexpr double kPi = std::numbers::pi;

std::string scene_with(const std::string& lights) {
  return scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n") + "lights:\n" + lights;
}

Source read_light(const std::string& light) {
  return read_scene(scene_with("  - " + light + "\n"), "test.yaml").sources.at(0);
}

TEST(Source, PointShinesAlikeAllAround) {
  const Source bulb = read_light("point: {position: [1, 2, 3], flux: 806}");
  EXPECT_EQ(bulb.name, "point 1");
  EXPECT_EQ(bulb.position, (Vec3{1, 2, 3}));
  EXPECT_NEAR(luminance(bulb.intensity), 806 / (4 * kPi), 1e-9);
  EXPECT_EQ(bulb.beam({0, 0, 1}), 1);
  EXPECT_EQ(bulb.beam({0, 0, -1}), 1);
  EXPECT_NEAR(luminous_flux(bulb), 806, 1e-9);
}

TEST(Source, BeamFadesBetweenItsAngles) {
  const Source spot = read_light(
      "spot: {position: [0, 0, 2], look_at: [0, 0, 0], angles: [20, 40], intensity: 100}");
  const auto at = [&](double degrees) {
    const double a = degrees * kPi / 180;
    return spot.beam({std::sin(a), 0, -std::cos(a)});
  };
  EXPECT_EQ(at(19.9), 1);
  EXPECT_EQ(at(40.1), 0);
  const double middle = std::acos((std::cos(20 * kPi / 180) + std::cos(40 * kPi / 180)) / 2);
  EXPECT_NEAR(at(middle * 180 / kPi), 0.25, 1e-12);
}

// The flux against a sum over many directions.
TEST(Source, FluxIsThatOfTheWholeBeam) {
  const Source spot = read_light(
      "spot: {position: [0, 0, 2], look_at: [1, 0, 0], angles: [10, 35], flux: 500, "
      "color: [1, 0.8, 0.2]}");
  constexpr int kSteps = 100000;
  double sum = 0;
  const Frame frame(spot.direction);
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = 1 - 2 * (i + 0.5) / kSteps, sine = std::sqrt(1 - cosine * cosine);
    sum += spot.beam(frame.to_world({sine, 0, cosine})) * 4 * kPi / kSteps;
  }
  EXPECT_NEAR(luminance(spot.intensity) * sum, 500, 0.01);
  EXPECT_NEAR(luminous_flux(spot), 500, 1e-9);
  EXPECT_NEAR(spot.intensity.g / spot.intensity.r, 0.8, 1e-12);
}

TEST(Source, DirectionalLightComesFromAfar) {
  const Source sun = read_light("{name: sun, directional: {direction: -z, illuminance: 1e5}}");
  EXPECT_EQ(sun.name, "sun");
  EXPECT_EQ(sun.kind, Source::Kind::directional);
  EXPECT_EQ(sun.direction, (Vec3{0, 0, -1}));
  EXPECT_EQ(sun.intensity, gray(1e5));
  EXPECT_EQ(luminous_flux(sun), 0);
}

TEST(Source, FaultsNameTheirPlace) {
  using testing::HasSubstr;
  const auto fault = [](const std::string& light) { return refusal(scene_with("  - " + light)); };
  EXPECT_THAT(fault("{name: lamp}"), HasSubstr("is one of 'point', 'spot' and 'directional'"));
  EXPECT_THAT(fault("{point: {position: [0, 0, 2], flux: 1}, directional: {direction: z, "
                    "illuminance: 1}}"),
              HasSubstr("a second kind in one light"));
  EXPECT_THAT(fault("point: {position: [0, 0, 2]}"), HasSubstr("one of 'intensity' (cd)"));
  EXPECT_THAT(fault("point: {position: [0, 0, 2], flux: 1, intensity: 1}"),
              HasSubstr("one of 'intensity' (cd)"));
  EXPECT_THAT(fault("point: {position: [0, 0, 2], flux: -1}"), HasSubstr("must not be negative"));
  EXPECT_THAT(fault("point: {position: [0, 0, 2], intensity: 1e16}"), HasSubstr("more than 1e15"));
  EXPECT_THAT(fault("spot: {position: [0, 0, 2], look_at: [0, 0, 2], angles: [1, 2], flux: 1}"),
              HasSubstr("must differ from 'position'"));
  EXPECT_THAT(fault("spot: {position: [0, 0, 2], angles: [1, 2], flux: 1}"),
              HasSubstr("one of 'direction' and 'look_at'"));
  for (const char* angles : {"[30, 20]", "[0, 0]", "[-1, 20]", "[20, 181]"}) {
    EXPECT_THAT(fault("spot: {position: [0, 0, 2], look_at: [0, 0, 0], flux: 1, angles: " +
                      std::string(angles) + "}"),
                HasSubstr("'angles' must rise from 0 to 180"))
        << angles;
  }
  EXPECT_THAT(fault("directional: {direction: [0, 0, 0], illuminance: 1}"),
              testing::StartsWith("test.yaml:"));
}

}  // namespace
}  // namespace isolux
