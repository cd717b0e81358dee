#pragma once

#include <algorithm>
#include <cmath>

namespace isolux {

/// Three channels, linear, with Rec. 709 primaries: a reflectance (0 to 1), or a photometric
/// quantity per channel (lm/m², lx, lm), scaled so that equal channels carry that same value.
struct Rgb {
  double r = 0, g = 0, b = 0;

  constexpr bool operator==(const Rgb&) const = default;
  constexpr Rgb& operator+=(const Rgb& c) { return r += c.r, g += c.g, b += c.b, *this; }
  constexpr Rgb& operator-=(const Rgb& c) { return r -= c.r, g -= c.g, b -= c.b, *this; }
  constexpr Rgb& operator*=(double s) { return r *= s, g *= s, b *= s, *this; }
};

constexpr Rgb gray(double value) { return {value, value, value}; }
constexpr Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
constexpr Rgb operator-(Rgb a, const Rgb& b) { return a -= b; }
constexpr Rgb operator*(Rgb a, double s) { return a *= s; }
constexpr Rgb operator*(double s, Rgb a) { return a *= s; }
constexpr Rgb operator*(const Rgb& a, const Rgb& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Rgb operator/(Rgb a, double s) { return a *= 1 / s; }

/// The photopic (CIE Y) value of a colour: its weighted mean by ITU-R BT.709.
constexpr double luminance(const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

inline bool is_finite(const Rgb& c) {
  return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}
constexpr double max_channel(const Rgb& c) { return std::max({c.r, c.g, c.b}); }
constexpr double min_channel(const Rgb& c) { return std::min({c.r, c.g, c.b}); }

}  // namespace isolux
