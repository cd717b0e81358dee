#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace isolux {

/// The numbers from lo to hi. Functions of intervals enclose all values that the function takes on
/// them, as rounded, and all reals where that is not known (R. E. Moore, Interval Analysis, 1966).
struct Enclosure {
  double lo = 0, hi = 0;

  constexpr Enclosure() = default;
  constexpr Enclosure(double number) : lo(number), hi(number) {}
  constexpr Enclosure(double low, double high) : lo(low), hi(high) {}
  bool holds(double number) const { return lo <= number && number <= hi; }
};

inline Enclosure all_reals() {
  return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
}

/// A little wider, for what rounding took; all reals for what is no interval.
inline Enclosure widened(double lo, double hi) {
  constexpr double kRounding = 8e-16, kTiny = 1e-300;
  lo -= std::abs(lo) * kRounding + kTiny;
  hi += std::abs(hi) * kRounding + kTiny;
  return lo <= hi ? Enclosure{lo, hi} : all_reals();
}

/// What holds both.
inline Enclosure hull(const Enclosure& a, const Enclosure& b) {
  return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}

inline Enclosure operator-(const Enclosure& a) { return {-a.hi, -a.lo}; }
inline Enclosure operator+(const Enclosure& a, const Enclosure& b) {
  return widened(a.lo + b.lo, a.hi + b.hi);
}
inline Enclosure operator-(const Enclosure& a, const Enclosure& b) {
  return widened(a.lo - b.hi, a.hi - b.lo);
}

inline Enclosure operator*(const Enclosure& a, const Enclosure& b) {
  const auto product = [](double x, double y) { return x == 0 || y == 0 ? 0 : x * y; };
  const double p = product(a.lo, b.lo), q = product(a.lo, b.hi);
  const double r = product(a.hi, b.lo), s = product(a.hi, b.hi);
  return widened(std::min(std::min(p, q), std::min(r, s)),
                 std::max(std::max(p, q), std::max(r, s)));
}

inline Enclosure operator/(const Enclosure& a, const Enclosure& b) {
  return b.holds(0) ? all_reals() : a * widened(1 / b.hi, 1 / b.lo);
}

/// a to the power n, by squaring.
inline double power(double a, int n) {
  double result = 1;
  for (; n > 0; n /= 2, a *= a) {
    if (n % 2 != 0) result *= a;
  }
  return result;
}

inline Enclosure power(const Enclosure& a, int n) {
  const double low = power(a.lo, n), high = power(a.hi, n);
  Enclosure result{std::min(low, high), std::max(low, high)};
  if (n % 2 == 0 && n > 0 && a.holds(0)) result.lo = 0;
  const double rounding = 2e-16 * n;
  return widened(result.lo - std::abs(result.lo) * rounding,
                 result.hi + std::abs(result.hi) * rounding);
}

inline Enclosure abs(const Enclosure& a) {
  const double low = std::abs(a.lo), high = std::abs(a.hi);
  return {a.holds(0) ? 0 : std::min(low, high), std::max(low, high)};
}

inline Enclosure cos(const Enclosure& a) {
  constexpr double kLargest = 1e9;  // beyond, the turns are not counted well
  constexpr double pi = std::numbers::pi;
  if (!(std::abs(a.lo) < kLargest && std::abs(a.hi) < kLargest)) return {-1, 1};
  constexpr double kSlack = 1e-6;          // a turning point that near counts as within
  const auto passes = [&](double place) {  // place + 2πk, within or nearly so
    const double k = std::ceil((a.lo - kSlack - place) / (2 * pi));
    return place + 2 * pi * k <= a.hi + kSlack;
  };
  const double first = std::cos(a.lo), last = std::cos(a.hi);
  Enclosure result = widened(std::min(first, last), std::max(first, last));
  if (passes(0)) result.hi = 1;
  if (passes(pi)) result.lo = -1;
  return result;
}

inline Enclosure sin(const Enclosure& a) { return cos(a - Enclosure(std::numbers::pi / 2)); }
inline Enclosure exp(const Enclosure& a) {
  const Enclosure rounded = widened(std::exp(a.lo), std::exp(a.hi));
  return {std::max(rounded.lo, 0.0), rounded.hi};
}
/// Of negative numbers 0, as in Expression.
inline Enclosure sqrt(const Enclosure& a) {
  const Enclosure rounded = widened(std::sqrt(std::max(a.lo, 0.0)), std::sqrt(std::max(a.hi, 0.0)));
  return {std::max(rounded.lo, 0.0), rounded.hi};
}

}  // namespace isolux
