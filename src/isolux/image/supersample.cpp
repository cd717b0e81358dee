#include "isolux/image/supersample.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/core/parallel.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {

constexpr int kMaxSide = 32'768;
constexpr std::int64_t kMaxPixels = 1 << 26;
constexpr int kMaxGrid = 64;

void check(const Camera& camera, const RenderOptions& options) {
  const std::int64_t pixels = std::int64_t{camera.width} * camera.height;
  if (std::min(camera.width, camera.height) < 1 ||
      std::max(camera.width, camera.height) > kMaxSide || pixels > kMaxPixels) {
    throw InputError(fmt::format(
        "a picture of {} × {} pixels can't be made: give 1 to {} a side, at most {} in all",
        camera.width, camera.height, kMaxSide, kMaxPixels));
  }
  if (options.grid < 1 || options.grid > kMaxGrid) {
    throw InputError(fmt::format("the samples a pixel must be 1 × 1 to {0} × {0}", kMaxGrid));
  }
}

}  // namespace

Picture supersample(const Camera& camera, const RenderOptions& options,
                    const std::function<Shade()>& new_shade) {
  check(camera, options);
  Picture picture(camera.width, camera.height);
  const int grid = options.grid;
  const double pixel = 1.0 / camera.height;
  const auto sample_row = [&](int y) {
    const Shade shade = new_shade();
    std::vector<Ray> rays(static_cast<std::size_t>(grid) * static_cast<std::size_t>(grid));
    for (int x = 0; x < camera.width; ++x) {
      const auto stream = static_cast<std::uint64_t>(y) * camera.width + x;
      Random random(options.seed, stream);
      const double v = (y + 0.5) * pixel, u = (x + 0.5) / camera.width;
      const double pixel_angle =
          distance(camera.ray(u, v).direction, camera.ray(u, v + pixel).direction);
      for (int cell = 0; cell < grid * grid; ++cell) {
        const double dx = (cell % grid + random.uniform()) / grid;
        const double dy = (cell / grid + random.uniform()) / grid;
        rays[static_cast<std::size_t>(cell)] =
            camera.ray((x + dx) / camera.width, (y + dy) * pixel);
      }
      picture.at(x, y) = shade(rays, pixel_angle);
    }
  };
  parallel_for(static_cast<std::size_t>(camera.height), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) sample_row(static_cast<int>(y));
  });
  return picture;
}

}  // namespace isolux
