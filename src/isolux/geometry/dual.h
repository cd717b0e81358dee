#pragma once

#include "isolux/geometry/enclosure.h"

namespace isolux {

/// A value with its derivative (forward differentiation), of numbers or of intervals. Where a
/// function has a kink, an interval's slope holds those of both sides.
template <typename Number>
struct Dual {
  Number value = 0, slope = 0;
};

template <typename N>
Dual<N> operator-(const Dual<N>& a) {
  return {-a.value, -a.slope};
}
template <typename N>
Dual<N> operator+(const Dual<N>& a, const Dual<N>& b) {
  return {a.value + b.value, a.slope + b.slope};
}
template <typename N>
Dual<N> operator-(const Dual<N>& a, const Dual<N>& b) {
  return {a.value - b.value, a.slope - b.slope};
}
template <typename N>
Dual<N> operator*(const Dual<N>& a, const Dual<N>& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope};
}
template <typename N>
Dual<N> operator/(const Dual<N>& a, const Dual<N>& b) {
  const N quotient = a.value / b.value;
  return {quotient, (a.slope - quotient * b.slope) / b.value};
}
template <typename N>
Dual<N> power(const Dual<N>& a, int n) {
  if (n == 0) return {N(1), N(0)};
  return {power(a.value, n), N(n) * power(a.value, n - 1) * a.slope};
}
template <typename N>
Dual<N> sin(const Dual<N>& a) {
  using std::cos, std::sin;
  return {sin(a.value), cos(a.value) * a.slope};
}
template <typename N>
Dual<N> cos(const Dual<N>& a) {
  using std::cos, std::sin;
  return {cos(a.value), -sin(a.value) * a.slope};
}
template <typename N>
Dual<N> exp(const Dual<N>& a) {
  using std::exp;
  const N value = exp(a.value);
  return {value, value * a.slope};
}

inline Dual<double> sqrt(const Dual<double>& a) {
  if (!(a.value > 0)) return {};
  const double root = std::sqrt(a.value);
  return {root, a.slope / (2 * root)};
}
inline Dual<Enclosure> sqrt(const Dual<Enclosure>& a) {
  if (a.value.hi <= 0) return {};
  const Enclosure root = sqrt(a.value);
  return {root, a.value.lo > 0 ? a.slope / (2.0 * root) : all_reals()};
}

inline Dual<double> abs(const Dual<double>& a) { return a.value < 0 ? -a : a; }
inline Dual<Enclosure> abs(const Dual<Enclosure>& a) {
  if (a.value.lo >= 0) return a;
  return a.value.hi <= 0 ? -a : Dual<Enclosure>{abs(a.value), hull(a.slope, -a.slope)};
}

inline Dual<double> min(const Dual<double>& a, const Dual<double>& b) {
  return b.value < a.value ? b : a;
}
inline Dual<Enclosure> min(const Dual<Enclosure>& a, const Dual<Enclosure>& b) {
  if (a.value.hi < b.value.lo) return a;
  if (b.value.hi < a.value.lo) return b;
  return {{std::min(a.value.lo, b.value.lo), std::min(a.value.hi, b.value.hi)},
          hull(a.slope, b.slope)};
}
template <typename N>
Dual<N> max(const Dual<N>& a, const Dual<N>& b) {
  return -min(-a, -b);
}

}  // namespace isolux
