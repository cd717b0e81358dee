#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace isolux {

/// The four polynomials of Bernstein of degree 3 at a place from 0 to 1, and their slopes.
struct CubicBasis {
  std::array<double, 4> value, slope;

  explicit CubicBasis(double t) {
    const double s = 1 - t;
    value = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    slope = {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t};
  }
};

/// A polynomial of degree 3 in u and in v on [0, 1]², by its coefficients in the basis of
/// Bernstein: four rows along u, one after the other along v. They enclose its values, and their
/// differences those of its derivatives.
struct Bicubic {
  std::array<double, 16> c = {};

  double at(const CubicBasis& u, const CubicBasis& v) const {
    double sum = 0;
    const auto row = along_v(v.value);
    for (std::size_t i = 0; i < 4; ++i) sum += row[i] * u.value[i];
    return sum;
  }

  struct ValueAndSlopes {
    double value, along_u, along_v;
  };
  ValueAndSlopes slopes_at(const CubicBasis& u, const CubicBasis& v) const {
    ValueAndSlopes sum{0, 0, 0};
    const auto row = along_v(v.value), slopes = along_v(v.slope);
    for (std::size_t i = 0; i < 4; ++i) {
      sum.value += row[i] * u.value[i];
      sum.along_u += row[i] * u.slope[i];
      sum.along_v += slopes[i] * u.value[i];
    }
    return sum;
  }

  /// Whether some value may be within `slack` of 0.
  bool may_vanish(double slack) const {
    const auto [least, most] = extremes();
    return least <= slack && most >= -slack;
  }
  double largest() const {
    const auto [least, most] = extremes();
    return std::max(-least, most);
  }
  /// No less than the distance of the slopes along u (axis 0) or v from `slope`.
  double slope_deviation(int axis, double slope) const {
    double most = 0;
    for_differences(axis, [&](double d) { most = std::max(most, std::abs(3 * d - slope)); });
    return most;
  }
  /// In the middle between the least and the greatest slope, as the coefficients tell.
  double middle_slope(int axis) const {
    double least = 3 * (c[axis == 0 ? 1 : 4] - c[0]), most = least;
    for_differences(
        axis, [&](double d) { least = std::min(least, 3 * d), most = std::max(most, 3 * d); });
    return 0.5 * (least + most);
  }
  /// No less than the second derivatives, along u twice (axes 0 and 0), u and v, or v twice.
  double largest_second(int axis, int other) const {
    const std::size_t step = axis == 0 ? 1 : 4, other_step = other == 0 ? 1 : 4;
    const double factor = axis == other ? 6 : 9;
    double most = 0;
    for (std::size_t i = 0; i < 16; ++i) {
      const std::size_t u = i % 4 + (axis == 0) + (other == 0);
      const std::size_t v = i / 4 + (axis == 1) + (other == 1);
      if (u > 3 || v > 3) continue;
      most = std::max(most,
                      std::abs(c[i + step + other_step] - c[i + step] - c[i + other_step] + c[i]));
    }
    return factor * most;
  }
  /// The part with u (axis 0) or v up to t, and the rest, each on [0, 1]² again.
  std::array<Bicubic, 2> split(int axis, double t) const {
    const std::size_t step = axis == 0 ? 1 : 4, line_step = axis == 0 ? 4 : 1;
    std::array<Bicubic, 2> both;
    for (std::size_t line = 0; line < 4; ++line) {
      const std::size_t first = line * line_step;
      std::array<double, 4> rest;
      for (std::size_t i = 0; i < 4; ++i) rest[i] = c[first + i * step];
      for (std::size_t k = 0; k < 4; ++k) {
        both[0].c[first + k * step] = rest[0];
        for (std::size_t i = 0; i + k < 3; ++i) rest[i] = (1 - t) * rest[i] + t * rest[i + 1];
      }
      for (std::size_t i = 0; i < 4; ++i) both[1].c[first + i * step] = rest[i];
    }
    return both;
  }

 private:
  /// The least and the greatest coefficient: by columns, for vector units.
  std::pair<double, double> extremes() const {
    std::array<double, 4> least = {c[0], c[1], c[2], c[3]}, most = least;
    for (std::size_t j = 1; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) {
        least[i] = std::min(least[i], c[4 * j + i]), most[i] = std::max(most[i], c[4 * j + i]);
      }
    }
    return {std::min(std::min(least[0], least[1]), std::min(least[2], least[3])),
            std::max(std::max(most[0], most[1]), std::max(most[2], most[3]))};
  }
  std::array<double, 4> along_v(const std::array<double, 4>& weights) const {
    std::array<double, 4> row = {};
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) row[i] += c[4 * j + i] * weights[j];
    }
    return row;
  }
  template <typename Visit>
  void for_differences(int axis, const Visit& visit) const {
    const std::size_t step = axis == 0 ? 1 : 4;
    for (std::size_t i = 0; i + step < 16; ++i) {
      if (axis == 1 || i % 4 != 3) visit(c[i + step] - c[i]);
    }
  }
};

}  // namespace isolux
