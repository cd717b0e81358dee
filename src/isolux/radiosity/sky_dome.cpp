#include "isolux/radiosity/sky_dome.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/sampling/concentric.h"

namespace isolux {

// Notation
//   Z     angle from the zenith
//   r     distance from the middle of the disk that the half above the horizon is mapped to, with
//         equal areas: r² = 1 − cos Z

SkyDome::SkyDome(const Sky& sky) : frame_(sky.up) {
  radiosity_.reserve(node_count());
  for (std::uint32_t j = 0; j < kSide; ++j) {
    for (std::uint32_t i = 0; i < kSide; ++i) {
      const auto [x, y] = square_to_disk({2.0 * i / (kSide - 1) - 1, 2.0 * j / (kSide - 1) - 1});
      const double squared = x * x + y * y;
      const double stretch = std::sqrt(std::max(0.0, 2 - squared));  // sin Z / r
      const Vec3 direction = frame_.to_world({x * stretch, y * stretch, 1 - squared});
      radiosity_.push_back(sky.zenith * (std::numbers::pi * sky.relative_luminance(direction)));
    }
  }
  radiosity_.push_back(sky.ground * std::numbers::pi);
}

MeshPlace SkyDome::place(const Vec3& direction) const {
  const double cos_z = dot(direction, frame_.n);
  if (!(cos_z > 0)) {
    const std::uint32_t ground = node_count() - 1;
    return {{ground, ground, ground}, {1, 0, 0}};
  }
  const double shrink = 1 / std::sqrt(1 + cos_z);  // r / sin Z
  const auto [x, y] =
      disk_to_square({dot(direction, frame_.u) * shrink, dot(direction, frame_.v) * shrink});
  const auto in_cell = [](double at, std::uint32_t& cell) {
    const double grid = std::clamp((at + 1) / 2, 0.0, 1.0) * (kSide - 1);
    cell = std::min(static_cast<std::uint32_t>(grid), kSide - 2);
    return grid - cell;
  };
  std::uint32_t i = 0, j = 0;
  const double s = in_cell(x, i), t = in_cell(y, j);
  const std::uint32_t first = j * kSide + i, last = first + kSide + 1;
  if (s >= t) return {{first, first + 1, last}, {1 - s, s - t, t}};
  return {{first, first + kSide, last}, {1 - t, t - s, s}};
}

}  // namespace isolux
