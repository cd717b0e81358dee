// Solves under a sky: energy, and the same bits however they are done. Values are held against
// closed forms and path tracing in tests/measure.

#include <gtest/gtest.h>

#include "isolux/core/parallel.h"
#include "isolux/radiosity/solve.h"
#include "isolux/radiosity/source_light.h"
#include "support/scenes.h"

namespace isolux {
namespace {

/// "overcast", or "clear", with the sun.
Scene daylit(const std::string& name) {
  return load_scene(source_dir() / "tests/measure/daylight" / (name + ".yaml"));
}

Options to_tolerance(double tolerance) {
  Options options;
  options.tolerance = tolerance;
  return options;
}

std::vector<Rgb> light_of(const Triangulation& mesh) {
  std::vector<Rgb> light;
  for (const Vertex& vertex : mesh.vertices()) light.push_back(vertex.irradiance);
  return light;
}

TEST(DaylightGathering, WhatComesInIsAbsorbedOrLeaves) {
  for (const std::string name : {"overcast", "clear"}) {
    const Scene scene = daylit(name);
    const Statistics s = solve(scene, to_tolerance(0.05)).statistics;
    EXPECT_NEAR(s.absorbed_flux + s.escaped_flux, s.emitted_flux, 0.01 * s.emitted_flux) << name;
    const RayCaster rays(scene);
    double arriving = arriving_flux(rays, *scene.sky);
    for (const Source& sun : scene.sources) arriving += arriving_flux(rays, sun);
    EXPECT_NEAR(s.emitted_flux, arriving, 0.01 * arriving) << name;
  }
}

TEST(DaylightGathering, ResultsDoNotDependOnTheNumberOfThreads) {
  std::vector<std::vector<Rgb>> light;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    light.push_back(light_of(solve(daylit("clear"), to_tolerance(0.05)).mesh));
  }
  EXPECT_EQ(light[0], light[1]);
}

TEST(DaylightGathering, GoesOnFromACheckpointToTheSameBits) {
  const Scene scene = daylit("clear");
  std::vector<GatheringState> checkpoints;
  const Solved whole =
      solve_by_gathering(scene, to_tolerance(0.05),
                         {{}, [&](const GatheringState& state) { checkpoints.push_back(state); }});
  ASSERT_GE(checkpoints.size(), 3u);
  const GatheringState& middle = checkpoints[checkpoints.size() / 2];
  ASSERT_FALSE(middle.around.empty()) << "what vertices see of the sky must be kept too";
  for (const GatheringState& checkpoint : {checkpoints.front(), middle, checkpoints.back()}) {
    const Solved rest = solve_by_gathering(scene, to_tolerance(0.05), {}, checkpoint);
    EXPECT_EQ(light_of(rest.mesh), light_of(whole.mesh));
  }
}

}  // namespace
}  // namespace isolux
