#pragma once

#include "isolux/geometry/bernstein.h"
#include "isolux/geometry/interval.h"

namespace isolux {

/// A polynomial of degree 3 in u and in v on [0, 1]², by its coefficients in the basis of
/// Bernstein: four rows along u, one after the other along v. They enclose its values.
struct Bicubic {
  std::array<double, 16> c = {};

  struct ValueAndSlopes {
    double value, along_u, along_v;
  };
  ValueAndSlopes at(double u, double v) const {
    Bernstein<3> values, slopes;
    for (std::size_t j = 0; j < 4; ++j) {
      const auto [value, slope] =
          Bernstein<3>{{c[4 * j], c[4 * j + 1], c[4 * j + 2], c[4 * j + 3]}}.at(u);
      values.c[j] = value, slopes.c[j] = slope;
    }
    const auto [value, along_v] = values.at(v);
    return {value, slopes(v), along_v};
  }

  Interval range() const {
    Interval all{c[0], c[0]};
    for (const double value : c) all = hull(all, Interval(value));
    return all;
  }
  /// Of the derivative along u (axis 0) or v (axis 1).
  Interval slopes(int axis) const {
    const std::size_t step = axis == 0 ? 1 : 4;
    Interval all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i + step < 16; ++i) {
      if (axis == 0 && i % 4 == 3) continue;
      all = hull(all, Interval(3 * (c[i + step] - c[i])));
    }
    return all;
  }
  /// The half with smaller u (axis 0) or v, and the other one, each on [0, 1]² again.
  std::array<Bicubic, 2> halves(int axis) const {
    const std::size_t step = axis == 0 ? 1 : 4, line_step = axis == 0 ? 4 : 1;
    std::array<Bicubic, 2> both;
    for (std::size_t line = 0; line < 4; ++line) {
      const std::size_t first = line * line_step;
      std::array<double, 4> rest;
      for (std::size_t i = 0; i < 4; ++i) rest[i] = c[first + i * step];
      for (std::size_t k = 0; k < 4; ++k) {
        both[0].c[first + k * step] = rest[0];
        for (std::size_t i = 0; i + k < 3; ++i) rest[i] = 0.5 * (rest[i] + rest[i + 1]);
      }
      for (std::size_t i = 0; i < 4; ++i) both[1].c[first + i * step] = rest[i];
    }
    return both;
  }
};

/// p a + q b.
inline Bicubic combined(double p, const Bicubic& a, double q, const Bicubic& b) {
  Bicubic sum;
  for (std::size_t i = 0; i < 16; ++i) sum.c[i] = p * a.c[i] + q * b.c[i];
  return sum;
}

}  // namespace isolux
