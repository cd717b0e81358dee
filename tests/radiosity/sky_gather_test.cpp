// Rays over a hemisphere where the sky shows through an opening.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "isolux/radiosity/hemisphere_gather.h"
#include "support/scenes.h"

namespace isolux {
namespace {

constexpr const char* kRoof = R"(
isolux: 1
sky: {type: uniform, illuminance: 100}
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

TEST(SkyGather, IsRightOnAverageAndAsNoisyAsItSays) {
  const Scene scene = scene_of(std::string(kRoof).substr(11));
  const RayCaster rays(scene);
  const Triangulation mesh({}, scene.bounds());
  const std::vector<std::uint8_t> separate(scene.objects.size());
  const HemisphereGather gather(rays, mesh, separate);
  const std::vector<Rgb> none(1);
  for (const auto& [z, expected] : {std::pair(1.25, 2.1983), {2.75, 1.0401}, {0.25, 1.2733}}) {
    for (const int grid : {8, 12, 24, 48, 96}) {
      double sum = 0, squares = 0, estimated = 0, n = 0, count = 0;
      Row<Landing> row;
      for (int seed = 0; seed < 400; ++seed) {
        gather.trace({{2, 0, z}, {0, 1, 0}}, grid, seed, 0, row);
        const Gathered found = gather.gather_with_error(row, none);
        const double e = luminance(found.irradiance);
        sum += e, squares += e * e, estimated += found.error * found.error, ++n;
        count += double(row.rays.size());
      }
      const double mean = sum / n, sigma = std::sqrt(squares / n - mean * mean);
      fmt::print("z {} grid {}: rays {:.0f} mean {:.4f} ({:.4f}) sigma {:.4f} estimated {:.4f}\n", z, grid, count/n,
                 mean, expected, sigma, std::sqrt(estimated / n));
    }
  }
}

}  // namespace
}  // namespace isolux
