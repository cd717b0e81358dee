#include "isolux/image/direct_finish.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "isolux/core/error.h"
#include "isolux/image/resample.h"
#include "isolux/radiosity/solve.h"
#include "solution/small_solution.h"
#include "support/penumbrae.h"

namespace isolux {
namespace {

/// A penumbra on a grey floor, solved so roughly that the mesh is coarse there.
Solution roughly_solved() {
  const std::string floor =
      "  - {shape: {parallelogram: {corner: [-3, -3, 0], u: [6, 0, 0], v: [0, 6, 0]}}, material: "
      "grey, sides: front}\n";
  Scene scene = scene_of(kMaterials + kSquareBehindEdge.light + kSquareBehindEdge.occluder + floor);
  Options options;
  options.tolerance = 0.03;
  Solved solved = solve(scene, options);
  return {std::move(scene), std::move(solved.mesh), options, solved.statistics, "test"};
}

/// The irradiance of the floor at (x, 0, 0), as a picture of one pixel shows it.
double seen(const Solution& solution, double x, bool direct) {
  Camera camera;
  camera.eye = {x, -1, 0.5};
  camera.look_at = {x, 0, 0};
  camera.fov = 0.05;
  camera.width = camera.height = 1;
  RenderOptions options;
  options.direct = direct;
  return luminance(render(solution, camera, options).picture.pixels.front()) * std::numbers::pi /
         0.5;
}

TEST(DirectFinish, ShadowsAreAsSharpAsTheyAre) {
  ISOLUX_NEED_SHARED();
  const Solution solution = roughly_solved();
  double whole = 0, off_by_mesh = 0;
  const auto values = true_values(kSquareBehindEdge);
  for (const auto& [x, e] : values) whole = std::max(whole, e);
  for (const auto& [x, e] : values) {
    if (std::abs(x) > 2.5) continue;
    EXPECT_NEAR(seen(solution, x, true), e, 0.004 * whole) << x;
    off_by_mesh = std::max(off_by_mesh, std::abs(seen(solution, x, false) - e));
  }
  EXPECT_GT(off_by_mesh, 0.01 * whole) << "the mesh is too good for this test";
}

TEST(DirectFinish, IsRefusedForShooting) {
  Solution solution = small_solution();
  solution.options.method = Method::shooting;
  RenderOptions options;
  options.direct = true;
  EXPECT_THROW(render(solution, solution.scene.camera("front"), options), InputError);
}

}  // namespace
}  // namespace isolux
