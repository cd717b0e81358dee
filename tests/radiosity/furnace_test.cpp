#include <fmt/format.h>
#include <gtest/gtest.h>

#include "isolux/radiosity/energy.h"
#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

/// A closed room of six walls, each with its reflectance and exitance, and a box that stands in it.
Scene furnace(const std::array<double, 7>& reflectance, const std::array<double, 7>& exitance) {
  std::string yaml = "materials:\n";
  for (int i = 0; i < 7; ++i)
    yaml += fmt::format("  m{}: {{reflectance: {}}}\n", i, reflectance[i]);
  yaml += "objects:\n";
  const char* shapes[] = {"parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}",
                          "parallelogram: {corner: [0, 0, 1], u: [0, 1, 0], v: [1, 0, 0]}",
                          "parallelogram: {corner: [0, 0, 0], u: [0, 1, 0], v: [0, 0, 1]}",
                          "parallelogram: {corner: [1, 0, 0], u: [0, 0, 1], v: [0, 1, 0]}",
                          "parallelogram: {corner: [0, 0, 0], u: [0, 0, 1], v: [1, 0, 0]}",
                          "parallelogram: {corner: [0, 1, 0], u: [1, 0, 0], v: [0, 0, 1]}",
                          "box: {lower: [0.3, 0.35, 0.3], upper: [0.6, 0.7, 0.65]}"};
  for (int i = 0; i < 7; ++i) {
    yaml += fmt::format(
        "  - {{shape: {{{}}}, material: m{}, sides: front, emission: {{exitance: {}}}}}\n",
        shapes[i], i, exitance[i]);
  }
  return scene_of(yaml);
}

/// The largest deviation of a corner's radiosity from `expected`, relative to it.
double worst_deviation(const Scene& scene, double expected) {
  Options options;
  options.method = Method::shooting;
  options.rules.max_edge = 0.25;
  options.refine = false;
  options.selection = Selection::power;
  options.iterations = 100000;
  options.stop_at_unshot = 1e-4;
  const Solved solved = solve(scene, options);
  EXPECT_TRUE(solved.statistics.converged);
  double worst = 0;
  for (const Triangle& triangle : solved.mesh.triangles()) {
    for (VertexId v : triangle.vertices) {
      const double b = luminance(triangle.emission + solved.mesh.vertex(v).radiosity());
      worst = std::max(worst, std::abs(b / expected - 1));
    }
  }
  return worst;
}

TEST(Furnace, WhiteEverySurfaceHasTheSameRadiosity) {
  // B = E (1 + ρ + ρ² + …) = E / (1 − ρ).
  for (double rho : {0.2, 0.5, 0.8}) {
    std::array<double, 7> reflectance, exitance;
    reflectance.fill(rho), exitance.fill(3);
    EXPECT_LT(worst_deviation(furnace(reflectance, exitance), 3 / (1 - rho)), 0.01) << rho;
  }
}

TEST(Furnace, ManufacturedAnyReflectancesGiveTheRadiosityAskedFor) {
  const std::array<double, 7> reflectance{0.1, 0.8, 0.5, 0.3, 0.7, 0, 0.6};
  std::array<double, 7> exitance;
  for (int i = 0; i < 7; ++i) exitance[i] = 20 * (1 - reflectance[i]);
  EXPECT_LT(worst_deviation(furnace(reflectance, exitance), 20), 0.01);
}

}  // namespace
}  // namespace isolux
