#include "isolux/radiosity/refine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/radiosity/solve.h"
#include "isolux/radiosity/spatial_order.h"
#include "isolux/radiosity/vertex_luminance.h"
#include "support/scenes.h"

namespace isolux {
namespace {

const char* kLampOverFloor = R"(
materials: {grey: {reflectance: 0.5}, lamp: {reflectance: 0}}
objects:
  - {shape: {parallelogram: {corner: [0, 0, 0], u: [2, 0, 0], v: [0, 2, 0]}}, material: grey, sides: front}
  - {shape: {parallelogram: {corner: [0.9, 0.9, 1], u: [0, 0.2, 0], v: [0.2, 0, 0]}}, material: lamp, sides: front, emission: {exitance: 100}}
cameras:
  above: {eye: [1, 1, 3], look_at: [1, 1, 0], up: [0, 1, 0], fov: 45}
)";

/// A lamp over a floor, and all that refinement needs.
struct Bench {
  Scene scene = scene_of(kLampOverFloor);
  RayCaster rays{scene};
  Options options = [] {
    Options o;
    o.rules = {0.3, 1e-4, 0.5};
    return o;
  }();
  Triangulation mesh{options.rules, scene.bounds()};
  Statistics statistics;

  Bench() { discretize_lights(scene, 0.3, mesh); }
  Refinement refinement() { return {mesh, rays, options, statistics}; }
  Shot shot_of(TriangleId id) { return {id, emitter_of(mesh, id), mesh.triangle(id).emission}; }
  double floor_area() const {
    double area = 0;
    for (const Triangle& t : mesh.triangles()) {
      if (t.alive && !t.on_light) area += t.area;
    }
    return area;
  }
  VertexId floor_vertex(double x, double y, double height) {
    return mesh.extend({{x, y, height}, {0, 0, 1}, {0, 0}, gray(0.5)}).value();
  }
};

TEST(Refine, TheEyePassCoversWhatTheCameraSeesAndNothingElse) {
  Bench bench;
  Refinement refinement = bench.refinement();
  refinement.refine_from_eye(bench.scene.camera("above"));
  // The picture's width is 4/3 of its height, 2 × 3 tan 22.5° = 2.49 m: all of the floor.
  EXPECT_GT(bench.floor_area(), 3.2);
  EXPECT_EQ(bench.statistics.refinement_rays, 32u * 32u);
  EXPECT_EQ(bench.statistics.shadow_rays, 0u) << "no light comes from the eye";
  EXPECT_THAT(bench.mesh.validate(), testing::IsEmpty());
}

TEST(Refine, NewbornVerticesHoldTheLightOfTheShotExactly) {
  Bench bench;
  Refinement refinement = bench.refinement();
  const Shot shot = bench.shot_of(0);
  refinement.refine(shot);
  ASSERT_GT(bench.statistics.extended, 50u);
  for (const Vertex& v : bench.mesh.vertices()) {
    if (v.on_light) continue;
    const Receiver receiver{v.position, v.normal};
    double factor = 0;
    visible_form_factors(bench.rays, shot.emitter, {&receiver, 1}, 1, {&factor, 1});
    EXPECT_EQ(v.delta_irradiance, shot.radiosity * factor);
    EXPECT_EQ(v.irradiance, v.delta_irradiance);
  }
}

TEST(Refine, ATriangleWithoutASceneBehindItIsRemoved) {
  Bench bench;
  // It hangs in the air, far from the floor in the measure of pairing.
  bench.floor_vertex(0.9, 0.9, 0.5), bench.floor_vertex(1.15, 0.9, 0.5);
  bench.floor_vertex(1.0, 1.15, 0.5);
  ASSERT_EQ(bench.mesh.triangle_count(), 3u);
  const auto hanging = static_cast<TriangleId>(bench.mesh.triangles().size() - 1);
  Refinement refinement = bench.refinement();
  refinement.refine(bench.shot_of(0));
  EXPECT_FALSE(bench.mesh.triangle(hanging).alive);
  EXPECT_TRUE(bench.mesh.triangle(0).alive) << "lights stay";
}

TEST(Refine, TrianglesAreSplitWhereTheirLightDiffersByMoreThanTheContrast) {
  for (const auto& [brightest, split] : {std::pair(1.1, false), {3.0, true}}) {
    Bench bench;
    bench.options.contrast = 1;
    const VertexId v = bench.floor_vertex(0.2, 0.2, 0), w = bench.floor_vertex(0.4, 0.2, 0),
                   x = bench.floor_vertex(0.2, 0.4, 0);
    for (VertexId u : {v, w, x}) bench.mesh.vertex(u).delta_irradiance = gray(1);
    bench.mesh.vertex(x).delta_irradiance = gray(brightest);
    Refinement refinement = bench.refinement();
    VertexLuminance luminance;
    luminance.add_newborn(bench.mesh);
    refinement.split_triangles(bench.shot_of(0), luminance.delta_irradiance);
    EXPECT_EQ(bench.statistics.split, split ? 1u : 0u)
        << "(max − min) / mean = " << (brightest - 1) / (2 + brightest) * 3;
    EXPECT_THAT(bench.mesh.validate(), testing::IsEmpty());
  }
}

TEST(SpatialOrder, HasEveryVertexOnceWhileTheMeshGrows) {
  Bench bench;
  SpatialOrder order;
  for (int i = 0; i < 40; ++i) {
    bench.floor_vertex(0.05 + 0.045 * i, 0.3 + 0.02 * (i % 7), 0);
    const auto list = order.of(bench.mesh);
    std::vector<VertexId> sorted(list.begin(), list.end());
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted.size(), bench.mesh.vertices().size());
    for (VertexId k = 0; k < sorted.size(); ++k) ASSERT_EQ(sorted[k], k);
  }
}

}  // namespace
}  // namespace isolux
