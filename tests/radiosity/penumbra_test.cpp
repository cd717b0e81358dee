#include <gtest/gtest.h>

#include "isolux/radiosity/gather.h"
#include "isolux/radiosity/options.h"
#include "isolux/radiosity/solve.h"
#include "support/penumbrae.h"

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
void expect_case(const PenumbraCase& penumbra) {
  ISOLUX_NEED_SHARED();
  const auto values = true_values(penumbra);
  ASSERT_GE(values.size(), 8u);
  for (const auto& [x, expected] : values) {
    const double whole = irradiance_at(penumbra.open(), x, 0);
    EXPECT_NEAR(irradiance_at(penumbra.shadowed(), x, Options{}.subdivisions), expected,
                0.005 * whole)
        << penumbra.file << " at x = " << x;
  }
}

TEST(Penumbra, OfASquareLightBehindAStraightEdge) { expect_case(kSquareBehindEdge); }

TEST(Penumbra, OfADiskLightBehindAStraightEdge) { expect_case(kDiskBehindEdge); }

TEST(Penumbra, OfADiskLightBehindADiskInsideItsOutline) { expect_case(kDiskBehindDisk); }

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
