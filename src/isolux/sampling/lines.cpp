#include "isolux/sampling/lines.h"

#include <numbers>

namespace isolux {

Line random_line(const Vec3& center, double radius, Random& random) {
  const double z = 2 * random.uniform() - 1, s = std::sqrt(1 - z * z);
  const double phi = 2 * std::numbers::pi * random.uniform();
  const Frame frame({s * std::cos(phi), s * std::sin(phi), z});
  const double r = radius * std::sqrt(random.uniform());
  const double angle = 2 * std::numbers::pi * random.uniform();
  return {center + frame.to_world({r * std::cos(angle), r * std::sin(angle), 0}), frame.n};
}

}  // namespace isolux
