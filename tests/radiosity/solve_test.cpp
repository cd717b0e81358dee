#include "isolux/radiosity/solve.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/core/error.h"
#include "isolux/core/parallel.h"
#include "isolux/radiosity/energy.h"
#include "support/scenes.h"

namespace isolux {
namespace {

Options quick() {
  Options options;
  options.method = Method::shooting;
  options.rules.max_edge = 0.2;
  options.iterations = 30;
  return options;
}

TEST(Solve, ResultsDoNotDependOnTheNumberOfThreads) {
  const Scene scene = paper_room();
  std::vector<Solved> solved;
  for (int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    solved.push_back(solve(scene, quick()));
  }
  for (const Solved& other : {std::cref(solved[1]), std::cref(solved[2])}) {
    const std::span<const Vertex> a = std::as_const(solved[0].mesh).vertices();
    const std::span<const Vertex> b = other.mesh.vertices();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].position, b[i].position);
      ASSERT_EQ(a[i].irradiance, b[i].irradiance);
    }
    ASSERT_EQ(solved[0].mesh.triangle_count(), other.mesh.triangle_count());
    EXPECT_EQ(solved[0].statistics.shadow_rays, other.statistics.shadow_rays);
  }
}

TEST(Solve, KeepsEveryInvariantAndCoversTheRoom) {
  const Solved solved = solve(paper_room(), quick());
  EXPECT_THAT(solved.mesh.validate(), testing::IsEmpty());
  // Six walls, pedestal and ball; flat triangles fall a little short of round surfaces.
  EXPECT_NEAR(solved.statistics.mesh_area, 6 + 0.3 * 0.1 * 3.1416 + 0.01 * 3.1416, 0.25);
}

TEST(Solve, OnAMeshThatStandsStillEveryShotLeavesLessUnshot) {
  const Scene scene = paper_room();
  Solved solved = solve(scene, quick());
  EXPECT_NEAR(solved.statistics.emitted_flux, 500, 1e-6);
  EXPECT_GT(solved.statistics.ambient_exitance, 0);
  Options options = quick();
  options.refine = false;
  options.selection = Selection::power;
  options.iterations = 500;
  double last = 1;
  const RayCaster rays(scene);
  transfer_energy(solved.mesh, rays, options, [&](const Progress& progress) {
    EXPECT_LT(progress.unshot_fraction, last);
    last = progress.unshot_fraction;
    return true;
  });
  EXPECT_LT(last, 0.55);
}

TEST(Solve, SelectionByPowerTransfersFaster) {
  Options options = quick();
  options.iterations = 300;
  const double by_radiosity = solve(paper_room(), options).statistics.unshot_flux;
  options.selection = Selection::power;
  EXPECT_LT(solve(paper_room(), options).statistics.unshot_flux, by_radiosity);
}

TEST(Solve, EveryDistributionAndLeastRaysCoverTheRoom) {
  for (Distribution distribution : {Distribution::malley, Distribution::uniform}) {
    for (int least : {0, 200}) {
      Options options = quick();
      options.iterations = 10;
      options.distribution = distribution;
      options.least_rays = least;
      EXPECT_GT(solve(paper_room(), options).statistics.mesh_area, 5.3);
    }
  }
}

TEST(Solve, StopsWhenTheCallerSaysSo) {
  int calls = 0;
  const Solved solved = solve(paper_room(), quick(), [&](const Progress& progress) {
    EXPECT_EQ(progress.iteration, ++calls);
    EXPECT_GT(progress.triangles, 2u);
    return calls < 5;
  });
  EXPECT_EQ(calls, 5);
  EXPECT_TRUE(solved.statistics.interrupted);
  EXPECT_EQ(solved.statistics.iterations, 5);
}

TEST(Solve, ThePapersMethodRefusesASky) {
  Scene scene = paper_room();
  scene.sky = Sky{};
  try {
    solve(scene, quick());
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("the scene has a sky"));
  }
}

TEST(Solve, DirectLightIsTheClosedForm) {
  // On a black floor, every vertex holds the form factor of the light alone.
  const Scene scene = scene_of(R"(
materials: {black: {reflectance: 0}}
objects:
  - {shape: {parallelogram: {corner: [0, 0, 0], u: [4, 0, 0], v: [0, 4, 0]}}, material: black, sides: front}
  - {shape: {parallelogram: {corner: [1.5, 1.5, 3], u: [0, 1, 0], v: [1, 0, 0]}}, material: black, sides: front, emission: {exitance: 3141.592653589793}}
)");
  Options options;
  options.method = Method::shooting;
  options.rules = {0.5, 1e-3, 0.5};
  options.iterations = 50;
  const Solved solved = solve(scene, options);
  EXPECT_TRUE(solved.statistics.converged);
  int checked = 0;
  for (const Vertex& v : solved.mesh.vertices()) {
    if (v.on_light || distance(v.position, {2, 2, 0}) > 0.2) continue;
    // The integral of L cos cos / d² over the light, by the midpoint rule.
    double expected = 0;
    for (int i = 0; i < 100; ++i) {
      for (int j = 0; j < 100; ++j) {
        const Vec3 d = Vec3{1.505 + 0.01 * i, 1.505 + 0.01 * j, 3} - v.position;
        expected += 1000 * 1e-4 * d.z * d.z / (length_squared(d) * length_squared(d));
      }
    }
    EXPECT_NEAR(luminance(v.irradiance) / expected, 1, 1e-4);
    ++checked;
  }
  EXPECT_GT(checked, 0);
}

TEST(Solve, ASphereLightInTheMiddleOfACubeLightsSixWallsAlike) {
  const Scene scene = scene_of(R"(
materials: {wall: {reflectance: 0.5}, lamp: {reflectance: 0}}
objects:
  - {shape: {box: {lower: [0, 0, 0], upper: [1, 1, 1], inward: true}}, material: wall}
  - {shape: {sphere: {center: [0.5, 0.5, 0.5], radius: 0.05}}, material: lamp, emission: {exitance: 1000}}
)");
  Options options = quick();
  options.iterations = 100;
  const Solved solved = solve(scene, options);
  std::array<double, 6> sum{}, count{};
  for (const Vertex& v : solved.mesh.vertices()) {
    if (v.on_light) continue;
    // Near the middle of its wall, where there are vertices enough for a mean.
    if (distance(v.position, {0.5, 0.5, 0.5}) > 0.6) continue;
    sum[v.surface.face] += luminance(v.irradiance);
    count[v.surface.face] += 1;
  }
  for (int face = 0; face < 6; ++face) {
    EXPECT_NEAR(sum[face] / count[face], sum[0] / count[0], 0.05 * sum[0] / count[0]) << face;
  }
}

TEST(Solve, UnusableScenesAndOptionsAreRefused) {
  EXPECT_THROW(solve(scene_of("materials: {m: {reflectance: 0}}\nobjects: [{shape: {sphere: "
                              "{center: [1e6, 0, 0], radius: 1}}, material: m, emission: "
                              "{exitance: 1}}]"),
                     quick()),
               InputError)
      << "too far from the origin for single precision";
  const Scene dark = scene_of(
      "materials: {m: {reflectance: 0.5}}\n"
      "objects: [{shape: {sphere: {center: [0, 0, 0], radius: 1}}, material: m}]");
  EXPECT_THROW(solve(dark, quick()), InputError);
  Options options = quick();
  options.camera = "nowhere";
  EXPECT_THROW(solve(paper_room(), options), InputError);
  for (auto spoil :
       {+[](Options& o) { o.contrast = -1; }, +[](Options& o) { o.grid = 0; },
        +[](Options& o) { o.rules.max_edge = NAN; }, +[](Options& o) { o.pairing_tolerance = NAN; },
        +[](Options& o) { o.iterations = -1; }}) {
    options = quick();
    spoil(options);
    EXPECT_THROW(solve(paper_room(), options), InputError);
  }
}

}  // namespace
}  // namespace isolux
