#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "isolux/core/error.h"
#include "isolux/core/parallel.h"
#include "isolux/image/resample.h"
#include "solution/small_solution.h"

namespace isolux {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

// In small_solution() the irradiance is the same everywhere: so is the luminance ρ E / π of each
// material, interpolated or extrapolated.
constexpr double kWall = 0.5 * kSmallIrradiance / std::numbers::pi;
constexpr double kBall = 0.8 * kSmallIrradiance / std::numbers::pi;
constexpr double kLamp = kSmallExitance / std::numbers::pi;

TEST(Render, UniformLightGivesUniformSurfacesAndATrueOutline) {
  const Solution solution = small_solution();
  Camera camera = solution.scene.camera("front");
  camera.width = 200, camera.height = 150;
  const Rendering rendering = render(solution, camera);

  // The outline of a sphere is a cone of half angle asin(r / d) about its centre.
  const Vec3 center{0.5, 0.5, 0.5};
  const double radius = std::asin(0.2 / distance(center, camera.eye));
  const double pixel = 2 * std::tan(camera.fov * std::numbers::pi / 360) / camera.height;
  int balls = 0, walls = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Vec3 d = camera.ray((x + 0.5) / camera.width, (y + 0.5) / camera.height).direction;
      const double off = std::acos(dot(d, normalized(center - camera.eye))) - radius;
      const double l = rendering.picture.at(x, y).g;
      if (off < -pixel) {
        EXPECT_NEAR(l, kBall, 1e-9) << x << ", " << y;
        ++balls;
      } else if (off > pixel && l < kWall * 1.001) {
        EXPECT_NEAR(l, kWall, 1e-9) << x << ", " << y;
        ++walls;
      }
    }
  }
  EXPECT_GT(balls, 500);
  EXPECT_GT(walls, 0.8 * 200 * 150 - balls);

  const SampleCounts& n = rendering.samples;
  EXPECT_EQ(n.interpolated + n.extrapolated, 200u * 150 * 16);
  EXPECT_GE(n.extrapolated, 16u * balls) << "the ball has no triangles";
}

TEST(Render, LampShowsItsExitanceFromTheFrontOnly) {
  const Solution solution = small_solution();
  Camera camera;
  camera.eye = {0.5, 0.5, 0.8}, camera.look_at = {0.5, 0.5, 1}, camera.up = {0, 1, 0};
  camera.fov = 10, camera.width = camera.height = 4;
  for (const Rgb& c : render(solution, camera).picture.pixels) EXPECT_NEAR(c.r, kLamp, 1e-9);
  camera.eye = {0.5, 0.5, 2};
  const Rendering behind = render(solution, camera);
  for (const Rgb& c : behind.picture.pixels) EXPECT_EQ(c, Rgb{});
  EXPECT_EQ(behind.samples.dark, 4u * 4 * 16);
}

TEST(Render, BackgroundIsBlack) {
  const Solution solution = small_solution();
  Camera camera;
  camera.eye = {0.5, 0.5, 2}, camera.look_at = {0.5, 0.5, 3}, camera.up = {0, 1, 0};
  camera.width = 3, camera.height = 2;
  const Rendering rendering = render(solution, camera, {.grid = 1});
  EXPECT_EQ(rendering.samples.background, 6u);
  for (const Rgb& c : rendering.picture.pixels) EXPECT_EQ(c, Rgb{});
}

TEST(Render, IsTheSameOnAnyNumberOfThreads) {
  Solution solution = small_solution();
  for (VertexId v = 0; v < solution.mesh.vertices().size(); ++v) {
    solution.mesh.vertex(v).irradiance = {10.0 + v, 20.0 * v, 3};
  }
  const Camera& camera = solution.scene.camera("front");
  std::vector<Rendering> renderings;
  for (int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    renderings.push_back(render(solution, camera));
  }
  EXPECT_EQ(renderings[0].picture.pixels, renderings[1].picture.pixels);
  EXPECT_EQ(renderings[0].picture.pixels, renderings[2].picture.pixels);
  EXPECT_EQ(renderings[0].samples.extrapolated, renderings[2].samples.extrapolated);
}

TEST(Render, SizesOutOfRangeAreRefused) {
  const Solution solution = small_solution();
  Camera camera = solution.scene.camera("front");
  const auto refused = ThrowsMessage<InputError>(HasSubstr("pixels can't be made"));
  for (const auto& [width, height] : {std::pair(0, 10), {10, -1}, {40'000, 1}, {32'768, 32'768}}) {
    camera.width = width, camera.height = height;
    EXPECT_THAT([&] { render(solution, camera); }, refused);
  }
  camera.width = camera.height = 1;
  EXPECT_THROW(render(solution, camera, {.grid = 0}), InputError);
  EXPECT_THROW(render(solution, camera, {.grid = 1000}), InputError);
}

}  // namespace
}  // namespace isolux
