#include "isolux/scene/source.h"

#include <numbers>

namespace isolux {
namespace {

double square(double x) { return x * x; }

}  // namespace

double Source::beam(const Vec3& way) const {
  const double full = cos_full(), dark = cos_dark(), at = dot(way, direction);
  if (at >= full) return 1;
  return at > dark ? square((at - dark) / (full - dark)) : 0;
}

double luminous_flux(const Source& source) {
  if (source.kind == Source::Kind::directional) return 0;
  // Over cos θ, the beam is a step of width 1 − cos full, and then a parabola.
  const double full = source.cos_full(), dark = source.cos_dark();
  return 2 * std::numbers::pi * luminance(source.intensity) * (1 - full + (full - dark) / 3);
}

}  // namespace isolux
