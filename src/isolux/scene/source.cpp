#include "isolux/scene/source.h"

#include <algorithm>
#include <cmath>

namespace isolux {
namespace {

double square(double x) { return x * x; }

}  // namespace

double Source::beam(const Vec3& way) const {
  const double full = std::cos(full_angle), dark = std::cos(dark_angle), at = dot(way, direction);
  if (at >= full) return 1;
  return at > dark ? square((at - dark) / (full - dark)) : 0;
}

double luminous_flux(const Source& source) {
  if (source.kind == Source::Kind::directional) return 0;
  // Over cos θ, the beam is a step of width 1 − cos full, and then a parabola.
  const double full = std::cos(source.full_angle), dark = std::cos(source.dark_angle);
  return 2 * std::numbers::pi * luminance(source.intensity) * (1 - full + (full - dark) / 3);
}

}  // namespace isolux
