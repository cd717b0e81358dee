#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "isolux/radiosity/gather.h"
#include "isolux/radiosity/options.h"
#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

/// Direct irradiance at (x, 0, 0), facing up, for an exitance of 1.
double irradiance_at(const Scene& scene, double x, int subdivisions) {
  Triangulation mesh({0.1, 1e-4, 0.5}, scene.bounds());
  discretize_lights(scene, 0.1, mesh);
  const RayCaster rays(scene);
  const Receiver receiver{{x, 0, 0}, {0, 0, 1}};
  Rgb irradiance;
  gather_irradiance(mesh, rays, {&receiver, 1}, subdivisions, {&irradiance, 1});
  return luminance(irradiance);
}

/// Every point of a case within 0.5 % of the irradiance of the light seen whole.
void expect_case(const std::string& file, const Scene& shadowed, const Scene& open) {
  ISOLUX_NEED_SHARED();
  std::ifstream in(shared_dir() / "validation/cases" / file);
  const auto values = nlohmann::json::parse(in).at("expected").at("values");
  ASSERT_GE(values.size(), 8u);
  for (const auto& [x, expected] : values.items()) {
    const double at = std::stod(x);
    const double whole = irradiance_at(open, at, 0);
    EXPECT_NEAR(irradiance_at(shadowed, at, Options{}.subdivisions), expected.get<double>(),
                0.005 * whole)
        << file << " at x = " << x;
  }
}

const std::string kMaterials = "materials: {black: {reflectance: 0}}\nobjects:\n";
const std::string kSquare =
    "  - {shape: {parallelogram: {corner: [-0.5, -0.5, 2], u: [0, 1, 0], v: [1, 0, 0]}}, "
    "material: black, sides: front, emission: {exitance: 1}}\n";
const std::string kDisk =
    "  - {shape: {disk: {center: [0, 0, 2], normal: [0, 0, -1], radius: 0.5}}, material: black, "
    "sides: front, emission: {exitance: 1}}\n";
const std::string kFarDisk =
    "  - {shape: {disk: {center: [0, 0, 4], normal: [0, 0, -1], radius: 1}}, material: black, "
    "sides: front, emission: {exitance: 1}}\n";
const std::string kHalfPlane =
    "  - {shape: {parallelogram: {corner: [-20, -20, 1], u: [20, 0, 0], v: [0, 40, 0]}}, "
    "material: black}\n";
const std::string kBlocker =
    "  - {shape: {disk: {center: [0, 0, 2], normal: [0, 0, 1], radius: 0.3}}, material: black}\n";

TEST(Penumbra, OfASquareLightBehindAStraightEdge) {
  expect_case("penumbra_square_halfplane.json", scene_of(kMaterials + kSquare + kHalfPlane),
              scene_of(kMaterials + kSquare));
}

TEST(Penumbra, OfADiskLightBehindAStraightEdge) {
  expect_case("penumbra_disc_halfplane.json", scene_of(kMaterials + kDisk + kHalfPlane),
              scene_of(kMaterials + kDisk));
}

TEST(Penumbra, OfADiskLightBehindADiskInsideItsOutline) {
  expect_case("annular_occluder_disc.json", scene_of(kMaterials + kFarDisk + kBlocker),
              scene_of(kMaterials + kFarDisk));
}

TEST(Penumbra, AStripNarrowerThanTheLightsTrianglesCastsItsShadow) {
  // A light of 2 × 2 triangles of 10 cm; a strip 4 cm wide just under it hides that much of it.
  const std::string light =
      "  - {shape: {parallelogram: {corner: [-0.05, -0.05, 1], u: [0, 0.1, 0], v: [0.1, 0, 0]}}, "
      "material: black, sides: front, emission: {exitance: 1}}\n";
  const std::string strip =
      "  - {shape: {parallelogram: {corner: [-0.02, -1, 0.98], u: [0.04, 0, 0], v: [0, 2, 0]}}, "
      "material: black}\n";
  const double whole = irradiance_at(scene_of(kMaterials + light), 0, 1);
  const double part = irradiance_at(scene_of(kMaterials + light + strip), 0, 1);
  EXPECT_NEAR(part / whole, 1 - 0.4 / 0.98, 0.01);
}

TEST(Penumbra, ASphereAsALightIsNotHiddenByItself) {
  // Closed form: E = M r² h / (h² + x²)^1.5.
  const Scene scene = scene_of(
      kMaterials +
      "  - {shape: {sphere: {center: [0, 0, 1.5], radius: 0.5}}, material: black, emission: "
      "{exitance: 1}}\n");
  for (double x : {0.0, 0.3, 1.0, 2.0}) {
    const double expected = 0.25 * 1.5 / std::pow(1.5 * 1.5 + x * x, 1.5);
    EXPECT_NEAR(irradiance_at(scene, x, 1), expected, 0.005 * expected) << x;
  }
}

}  // namespace
}  // namespace isolux
