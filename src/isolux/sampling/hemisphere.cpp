#include "isolux/sampling/hemisphere.h"

#include <numbers>

namespace isolux {

std::vector<Vec3> uniform_hemisphere(const Frame& frame, int grid, Random& random) {
  std::vector<Vec3> directions;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const double phi = 2 * std::numbers::pi * (i + random.uniform()) / grid;
      const double cosine = (j + random.uniform()) / grid;
      const double sine = std::sqrt(1 - cosine * cosine);
      directions.push_back(frame.to_world({sine * std::cos(phi), sine * std::sin(phi), cosine}));
    }
  }
  return directions;
}

std::vector<Vec3> malley_hemisphere(const Frame& frame, int grid, Random& random) {
  // Points this close to the rim would give rays inside the surface they start from.
  constexpr double kRim = 0.9999;
  std::vector<Vec3> directions;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const double x = 2 * (i + random.uniform()) / grid - 1;
      const double y = 2 * (j + random.uniform()) / grid - 1;
      const double r2 = x * x + y * y;
      if (r2 < kRim) directions.push_back(frame.to_world({x, y, std::sqrt(1 - r2)}));
    }
  }
  return directions;
}

}  // namespace isolux
