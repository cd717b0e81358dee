// Rays over a hemisphere where the sky shows through an opening.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "isolux/radiosity/hemisphere_gather.h"
#include "support/scenes.h"

namespace isolux {
namespace {

/// A black room of 4 × 4 × 3 m, in the middle of its ceiling an opening of 1 × 1 m.
constexpr const char* kRoof = R"(sky: {type: uniform, illuminance: 100}
materials: {black: {reflectance: 0}}
objects:
  - {material: black, shape: {parallelogram: {corner: [0, 0, 3], u: [0, 4, 0], v: [1.5, 0, 0]}}}
  - {material: black, shape: {parallelogram: {corner: [2.5, 0, 3], u: [0, 4, 0], v: [1.5, 0, 0]}}}
  - {material: black, shape: {parallelogram: {corner: [1.5, 0, 3], u: [0, 1.5, 0], v: [1, 0, 0]}}}
  - {material: black, shape: {parallelogram: {corner: [1.5, 2.5, 3], u: [0, 1.5, 0], v: [1, 0, 0]}}}
  - {material: black, shape: {parallelogram: {corner: [0, 0, 0], u: [4, 0, 0], v: [0, 4, 0]}}}
  - {material: black, shape: {parallelogram: {corner: [0, 0, 0], u: [0, 4, 0], v: [0, 0, 3]}}}
  - {material: black, shape: {parallelogram: {corner: [4, 0, 0], u: [0, 0, 3], v: [0, 4, 0]}}}
  - {material: black, shape: {parallelogram: {corner: [0, 4, 0], u: [4, 0, 0], v: [0, 0, 3]}}}
  - {material: black, shape: {parallelogram: {corner: [0, 0, 0], u: [0, 0, 3], v: [4, 0, 0]}}}
)";

/// The illuminance through the opening (lx) in the middle of the wall at y = 0, at height z: form
/// factors of a rectangle in a plane across the receiver's, from its two edges along the wall.
double through_the_opening(double z) {
  const auto up_to = [&](double y) {
    const double up = 3 - z, away = std::hypot(up, y);
    return up / away * std::atan(0.5 / away) / std::numbers::pi;
  };
  return 100 * (up_to(1.5) - up_to(2.5));
}

struct Spread {
  double mean, deviation;  ///< of the irradiances that different seeds give, lx
  double estimated;        ///< root of the mean of the variances that they give themselves, lx
};

constexpr int kSeeds = 200;

Spread spread_of(const HemisphereGather& gather, double z, int grid) {
  const std::vector<Rgb> no_vertices(1);
  Row<Landing> row;
  double sum = 0, squares = 0, estimated = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    gather.trace({{2, 0, z}, {0, 1, 0}}, grid, static_cast<std::uint64_t>(seed), 0, row);
    const Gathered found = gather.gather_with_error(row, no_vertices);
    const double e = luminance(found.irradiance);
    sum += e / kSeeds, squares += e * e / kSeeds, estimated += found.error * found.error / kSeeds;
  }
  return {sum, std::sqrt(squares - sum * sum), std::sqrt(estimated)};
}

TEST(SkyGather, IsRightOnAverageAndAsNoisyAsItSays) {
  const Scene scene = scene_of(kRoof);
  const RayCaster rays(scene);
  const Triangulation mesh({}, scene.bounds());
  const std::vector<std::uint8_t> separate(scene.objects.size());
  const HemisphereGather gather(rays, mesh, separate);
  for (const double z : {0.25, 1.25, 2.75}) {
    const double expected = through_the_opening(z);
    double coarser = std::numeric_limits<double>::infinity();
    for (const int grid : {8, 24, 48}) {
      SCOPED_TRACE(testing::Message() << "z " << z << ", grid " << grid);
      const auto [mean, deviation, estimated] = spread_of(gather, z, grid);
      EXPECT_NEAR(mean, expected, 3 * deviation / std::sqrt(kSeeds) + 2e-4 * expected);
      // The opening fills one to two cells of the coarsest grid: only the size of the error can be
      // known then. In fine ones second differences over its rim say too much.
      EXPECT_GT(estimated, 0.6 * deviation);
      EXPECT_LT(estimated, 4 * deviation);
      // One jittered point in each cell is worth grid^(-3/2) at rims; dividing these, more.
      const double at_rims = deviation * std::pow(grid, 1.5);
      EXPECT_LT(at_rims, coarser);
      coarser = at_rims;
    }
  }
}

}  // namespace
}  // namespace isolux
