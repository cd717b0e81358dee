#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "isolux/core/error.h"
#include "isolux/radiosity/energy.h"
#include "isolux/radiosity/furnace.h"
#include "isolux/radiosity/solve.h"
#include "isolux/sampling/lines.h"
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
  const Scene boxes = scene_of(R"(
materials: {any: {reflectance: 0}}
objects:
  - {shape: {box: {lower: [0, 0, 0], upper: [0.3, 0.4, 0.3]}}, material: any}
  - {shape: {box: {lower: [0.7, 0.6, 0.5], upper: [1, 1, 1]}}, material: any}
)");
  EXPECT_LT(worst_deviation(furnace_scene(boxes, 20), 20), 0.01);
}

const char* const kSheetAndBall = R"(
materials: {any: {reflectance: [0.1, 0.2, 0.3]}}
objects:
  - {name: up, shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}}, material: any, sides: front}
  - {name: ball, shape: {sphere: {center: [0.5, 0.5, 1], radius: 0.3}}, material: any, emission: {flux: 9}}
lights:
  - {point: {position: [0, 0, 3], flux: 100}}
sky: {type: overcast, illuminance: 10000, ground: 300}
)";

TEST(FurnaceScene, ClosesTheSceneAndLetsAllSidesGlow) {
  const Scene scene = furnace_scene(scene_of(kSheetAndBall), 50);
  ASSERT_EQ(scene.objects.size(), 4u) << "sheet, ball, the sheet's back, the box";
  EXPECT_TRUE(scene.sources.empty());
  EXPECT_FALSE(scene.sky);
  EXPECT_EQ(scene.objects[2].name, "up (back)");
  std::set<double> reflectances;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const double reflectance = scene.material_of(i).reflectance.g;
    EXPECT_GE(reflectance, 0.2);
    EXPECT_LE(reflectance, 0.8);
    EXPECT_NEAR(scene.objects[i].exitance.g, 50 * (1 - reflectance), 1e-12);
    reflectances.insert(reflectance);
  }
  EXPECT_EQ(reflectances.size(), scene.objects.size());
  const RayCaster rays(scene);
  Random random(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 way = random_line({}, 1, random).direction;
    const auto hit = rays.nearest({{0.5, 0.5, 0.1}, way});
    ASSERT_TRUE(hit);
    EXPECT_LT(dot(hit->normal, way), 0) << "it glows towards all who look";
  }
}

TEST(FurnaceScene, ReportSaysWhatIsWrongAndWhere) {
  const Scene scene = furnace_scene(scene_of(kSheetAndBall), 50);
  Options options;
  options.tolerance = 0.05;
  Solved solved = solve(scene, options);
  const FurnaceReport good = judge_furnace(scene, solved.mesh, solved.statistics, 50);
  EXPECT_LT(good.rms, 1e-3);
  EXPECT_LT(std::abs(good.worst), 0.005);
  // Light from nowhere, on one vertex of the ball.
  for (Vertex& vertex : solved.mesh.vertices()) {
    if (vertex.surface.object != 1 || vertex.triangles.empty()) continue;
    vertex.irradiance += gray(10);
    const FurnaceReport bad = judge_furnace(scene, solved.mesh, solved.statistics, 50);
    EXPECT_EQ(bad.object, 1u);
    EXPECT_EQ(bad.place, vertex.position);
    EXPECT_NEAR(bad.worst, vertex.reflectance.g * 10 / 50, 0.005);
    EXPECT_GT(bad.rms, good.rms);
    break;
  }
}

TEST(FurnaceScene, NothingCannotBeAFurnace) { EXPECT_THROW(furnace_scene(Scene{}, 1), InputError); }

}  // namespace
}  // namespace isolux
