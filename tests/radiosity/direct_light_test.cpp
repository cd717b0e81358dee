#include "isolux/radiosity/direct_light.h"
#include "isolux/radiosity/separate_lights.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "isolux/core/parallel.h"
#include "isolux/core/random.h"
#include "support/penumbrae.h"

namespace isolux {
namespace {

struct Lit {
  double irradiance = 0, error = 0;
};

Lit lit(const Scene& scene, const Receiver& receiver, double tolerance = 0) {
  const RayCaster rays(scene);
  const DirectLight light(rays);
  Rgb irradiance;
  double error = 0;
  light.irradiance({&receiver, 1}, {&irradiance, 1}, {&error, 1}, tolerance);
  return {luminance(irradiance), error};
}

Lit lit_floor(const Scene& scene, double x, double tolerance = 0) {
  return lit(scene, {{x, 0, 0}, {0, 0, 1}}, tolerance);
}

/// Every point of a case within 0.15 % of the irradiance of the light seen whole, or half the
/// tolerance more where it is searched to one, and within four standard deviations.
void expect_case(const PenumbraCase& penumbra) {
  ISOLUX_NEED_SHARED();
  const auto values = true_values(penumbra);
  ASSERT_GE(values.size(), 8u);
  for (const double tolerance : {0.0, 0.01, 0.08}) {
    for (const auto& [x, expected] : values) {
      const Lit found = lit_floor(penumbra.shadowed(), x, tolerance);
      const double whole = lit_floor(penumbra.open(), x).irradiance;
      EXPECT_NEAR(found.irradiance, expected, (0.0015 + tolerance / 2) * whole)
          << penumbra.file << ", x = " << x << ", tolerance " << tolerance;
      EXPECT_NEAR(found.irradiance, expected, 4 * found.error + 1e-4 * whole)
          << penumbra.file << ", x = " << x << ", tolerance " << tolerance;
    }
  }
}

TEST(DirectLight, PenumbraOfASquareBehindAStraightEdge) { expect_case(kSquareBehindEdge); }

TEST(DirectLight, PenumbraOfADiskBehindAStraightEdge) { expect_case(kDiskBehindEdge); }

TEST(DirectLight, PenumbraOfADiskBehindADiskInsideItsOutline) { expect_case(kDiskBehindDisk); }

TEST(DirectLight, AStripOfAnEighthOfTheLightCastsItsShadow) {
  // Just under a square light of 10 cm runs a strip 1.5 cm wide, wherever it may be.
  const std::string light =
      "  - {shape: {parallelogram: {corner: [-0.05, -0.05, 1], u: [0, 0.1, 0], v: [0.1, 0, 0]}}, "
      "material: black, sides: front, emission: {exitance: 1}}\n";
  const double whole = lit_floor(scene_of(kMaterials + light), 0).irradiance;
  for (double left : {-0.04, -0.033, -0.0075, 0.0, 0.011, 0.03}) {
    const std::string strip = fmt::format(
        "  - {{shape: {{parallelogram: {{corner: [{}, -1, 0.98], u: [0.015, 0, 0], v: [0, 2, "
        "0]}}}}, material: black}}\n",
        left);
    const double part = lit_floor(scene_of(kMaterials + light + strip), 0).irradiance;
    EXPECT_NEAR(part / whole, 1 - 0.15 / 0.98, 0.003) << left;
  }
}

TEST(DirectLight, ASphereIsNotHiddenByItself) {
  // Closed form: E = M r² h / (h² + x²)^1.5.
  const Scene scene = scene_of(
      kMaterials +
      "  - {shape: {sphere: {center: [0, 0, 1.5], radius: 0.5}}, material: black, emission: "
      "{exitance: 1}}\n" +
      "  - {shape: {sphere: {center: [9, 9, 9], radius: 0.1}}, material: black}\n");
  for (double x : {0.0, 0.3, 1.0, 2.0}) {
    const double expected = 0.25 * 1.5 / std::pow(1.5 * 1.5 + x * x, 1.5);
    const Lit found = lit_floor(scene, x);
    EXPECT_NEAR(found.irradiance, expected, 1e-12) << x;
    EXPECT_EQ(found.error, 0) << x;
  }
}

TEST(DirectLight, LargeLightsNearByAreExact) {
  // Irradiance in the middle under a parallel square of half-width a at height h: four times the
  // configuration factor of a quarter, 4 · (1/2π) · 2 X/√(1+X²) atan(X/√(1+X²)), X = a/h.
  const Scene scene = scene_of(kMaterials + kSquare);
  for (double h : {2.0, 0.3, 0.01}) {
    const double x = 0.5 / h, root = std::sqrt(1 + x * x);
    const double expected = 4 / std::numbers::pi * x / root * std::atan(x / root);
    EXPECT_NEAR(lit(scene, {{0, 0, 2 - h}, {0, 0, 1}}).irradiance, expected, 1e-9) << h;
  }
}

TEST(DirectLight, ALightOnTheHorizonOfAnOccludersOwnSurface) {
  // A point on the side of a cylinder sees half of a light overhead, and nothing hides that half.
  const std::string light =
      "  - {shape: {parallelogram: {corner: [-0.5, -0.5, 1], u: [0, 1, 0], v: [1, 0, 0]}}, "
      "material: black, sides: front, emission: {exitance: 1}}\n";
  const std::string cylinder =
      "  - {shape: {cylinder: {from: [-0.1, 0, -1], to: [-0.1, 0, 0.5], radius: 0.1}}, material: "
      "black}\n";
  const Receiver receiver{{0, 0, 0.3}, {1, 0, 0}};
  const double open = lit(scene_of(kMaterials + light), receiver).irradiance;
  EXPECT_GT(open, 0.05);
  EXPECT_NEAR(lit(scene_of(kMaterials + light + cylinder), receiver).irradiance, open, 1e-3 * open);
}

TEST(DirectLight, ErrorsAreHonestInThePapersRoom) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  const DirectLight light(rays);
  // The floor around the pedestal, where the ball's penumbra falls, and the pedestal itself.
  std::vector<Receiver> receivers;
  Random random(5);
  for (int i = 0; i < 400; ++i) {
    const double angle = 2 * std::numbers::pi * random.uniform(),
                 r = 0.051 + 0.06 * random.uniform();
    receivers.push_back({{0.5 + r * std::cos(angle), 0.5 + r * std::sin(angle), 0}, {0, 0, 1}});
  }
  std::vector<Rgb> irradiance(receivers.size());
  std::vector<double> error(receivers.size());
  light.irradiance(receivers, irradiance, error);

  constexpr int kSide = 200;
  const double exitance = luminance(scene.objects.back().exitance);
  int penumbra = 0, inside = 0;
  std::vector<Segment> segments;
  std::vector<std::uint8_t> blocked(kSide * kSide);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    if (error[i] == 0) continue;
    const Vec3 from = receivers[i].point;
    segments.clear();
    double expected = 0;
    for (int k = 0; k < kSide * kSide; ++k) {
      const double a = (k % kSide + random.uniform()) / kSide;
      const double b = (k / kSide + random.uniform()) / kSide;
      segments.push_back({from + Vec3{0, 0, rays.epsilon()},
                          {0.45 + 0.1 * a, 0.45 + 0.1 * b, 1 - rays.epsilon()}});
    }
    rays.occluded(segments, blocked);
    for (std::size_t k = 0; k < segments.size(); ++k) {
      const double squared = length_squared(segments[k].to - from);
      if (!blocked[k]) {
        expected += exitance * 0.01 / (std::numbers::pi * squared * squared) / (kSide * kSide);
      }
    }
    ++penumbra;
    // The stratified reference is itself off by about 1e-4 of the whole.
    const double whole = exitance * 0.01 / std::numbers::pi;
    EXPECT_NEAR(luminance(irradiance[i]), expected, 0.002 * whole);
    inside += std::abs(luminance(irradiance[i]) - expected) < 2 * error[i] + 1e-4 * whole;
  }
  EXPECT_GT(penumbra, 50);
  EXPECT_GE(inside, 0.95 * penumbra);
}

TEST(DirectLight, DoesNotDependOnTheNumberOfThreads) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  const DirectLight light(rays);
  std::vector<Receiver> receivers;
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    receivers.push_back({{random.uniform(), random.uniform(), 0}, {0, 0, 1}});
  }
  std::vector<std::vector<Rgb>> results;
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    std::vector<double> error(receivers.size());
    results.emplace_back(receivers.size());
    light.irradiance(receivers, results.back(), error);
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(SeparateLights, AreThoseThatStandOut) {
  const auto separate = [](const std::string& objects) {
    return separate_lights(scene_of(kMaterials + objects));
  };
  const std::string room =
      "  - {shape: {box: {lower: [-2, -2, 0], upper: [2, 2, 2.1], inward: true}}, material: "
      "grey}\n";
  EXPECT_EQ(separate(kSquare), std::vector<std::uint8_t>({1}));
  EXPECT_EQ(separate(room + kSquare), std::vector<std::uint8_t>({0, 1}));
  // In a furnace none does, whatever its reflectance: B₀ (1 − ρ) is at most B₀.
  const std::string furnace =
      "  - {shape: {box: {lower: [-2, -2, 0], upper: [2, 2, 2.1], inward: true}}, material: grey, "
      "emission: {exitance: 5}}\n"
      "  - {shape: {sphere: {center: [0, 0, 1], radius: 0.5}}, material: black, emission: "
      "{exitance: 10}}\n"
      "  - {shape: {sphere: {center: [1, 1, 1], radius: 0.3}}, material: grey, emission: "
      "{exitance: 5}}\n";
  EXPECT_EQ(separate(furnace), std::vector<std::uint8_t>({0, 0, 0}));
}

}  // namespace
}  // namespace isolux
