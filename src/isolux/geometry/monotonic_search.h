#pragma once

#include "isolux/geometry/bracketed_root.h"

namespace isolux {

/// Calls found(s) for every place in [a, b] where f, whose second derivative is within ± curvature,
/// changes its sign. Intervals that can't hold a root are dropped, those on which f is monotonic
/// searched, all others halved; pairs of roots closer than 1e-10 may be missed together.
/// f(s) returns a ValueAndSlope; s should be scaled to about 1.
template <typename F, typename Found>
void find_sign_changes(const F& f, double curvature, double a, double b, const Found& found) {
  constexpr double kShortest = 1e-10;
  const double half = 0.5 * (b - a), middle = a + half;
  const auto [value, slope] = f(middle);
  const double bend = curvature * half;
  if (!(std::abs(value) <= (std::abs(slope) + 0.5 * bend) * half)) return;
  if (std::abs(slope) > bend || half < kShortest) {
    const bool rising = f(a).value < 0;
    if (rising != (f(b).value < 0)) found(bracketed_root(f, a, b, rising));
    return;
  }
  find_sign_changes(f, curvature, a, middle, found);
  find_sign_changes(f, curvature, middle, b, found);
}

}  // namespace isolux
