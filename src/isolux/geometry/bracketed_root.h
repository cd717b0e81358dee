#pragma once

#include <cmath>

namespace isolux {

/// A function's value and derivative at one place.
struct ValueAndSlope {
  double value, slope;
};

/// The root of f between a and b, f growing from negative to positive if `rising`, falling if not:
/// Newton's method kept inside the bracket by bisection. f(s) returns a ValueAndSlope; s should be
/// scaled to about 1, as the step that counts as none is 1e-16.
template <typename F>
double bracketed_root(const F& f, double a, double b, bool rising) {
  double s = 0.5 * (a + b);
  for (int i = 0; i < 200; ++i) {
    const auto [value, slope] = f(s);
    if (value == 0) return s;
    ((value < 0) == rising ? a : b) = s;
    double next = s - value / slope;
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (std::abs(next - s) <= 1e-16 || next == a || next == b) return next;
    s = next;
  }
  return s;
}

}  // namespace isolux
