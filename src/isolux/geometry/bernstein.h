#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "isolux/geometry/bracketed_root.h"

namespace isolux {

/// A polynomial on [0, 1] by its coefficients in the basis of Bernstein, which enclose its values:
/// where they have one sign it has no zero, where they change it once exactly one (Lane and
/// Riesenfeld 1981).
template <std::size_t degree>
struct Bernstein {
  std::array<double, degree + 1> c = {};

  /// By de Casteljau's scheme, stable for all u.
  ValueAndSlope at(double u) const {
    auto b = c;
    for (std::size_t n = degree; n > 1; --n) {
      for (std::size_t i = 0; i < n; ++i) b[i] += u * (b[i + 1] - b[i]);
    }
    return {b[0] + u * (b[1] - b[0]), static_cast<double>(degree) * (b[1] - b[0])};
  }
  double operator()(double u) const { return at(u).value; }

  Bernstein<degree - 1> derivative() const {
    Bernstein<degree - 1> d;
    for (std::size_t i = 0; i < degree; ++i) d.c[i] = degree * (c[i + 1] - c[i]);
    return d;
  }
};

template <std::size_t n>
Bernstein<n> operator+(Bernstein<n> a, const Bernstein<n>& b) {
  for (std::size_t i = 0; i <= n; ++i) a.c[i] += b.c[i];
  return a;
}

template <std::size_t n>
Bernstein<n> operator-(Bernstein<n> a, const Bernstein<n>& b) {
  for (std::size_t i = 0; i <= n; ++i) a.c[i] -= b.c[i];
  return a;
}

template <std::size_t n>
Bernstein<n> operator*(Bernstein<n> a, double factor) {
  for (double& c : a.c) c *= factor;
  return a;
}

template <std::size_t n>
Bernstein<n> operator+(Bernstein<n> a, double constant) {
  for (double& c : a.c) c += constant;
  return a;
}

template <std::size_t m, std::size_t n>
Bernstein<m + n> operator*(const Bernstein<m>& a, const Bernstein<n>& b) {
  constexpr auto binomials = [](std::size_t degree) {
    std::array<double, m + n + 1> row = {1};
    for (std::size_t i = 0; i < degree; ++i) {
      row[i + 1] = row[i] * static_cast<double>(degree - i) / static_cast<double>(i + 1);
    }
    return row;
  };
  static constexpr auto of_a = binomials(m), of_b = binomials(n), of_both = binomials(m + n);
  Bernstein<m + n> product;
  for (std::size_t i = 0; i <= m; ++i) {
    for (std::size_t j = 0; j <= n; ++j) {
      product.c[i + j] += of_a[i] * a.c[i] * of_b[j] * b.c[j];
    }
  }
  for (std::size_t i = 0; i <= m + n; ++i) product.c[i] /= of_both[i];
  return product;
}

/// Calls found(u) for the zeros in [0, 1] at which the polynomial changes its sign, in ascending
/// order. Pairs of zeros closer than 1e-9 may be missed together.
template <std::size_t n, typename Found>
void find_zeros(const Bernstein<n>& f, const Found& found, double from = 0, double to = 1) {
  std::size_t changes = 0;
  for (std::size_t i = 0; i < n; ++i) changes += (f.c[i] < 0) != (f.c[i + 1] < 0);
  if (changes == 0) return;
  const double width = to - from;
  if (changes == 1 || width < 1e-9) {
    const bool rising = f.c[0] < 0;
    if (rising == (f.c[n] < 0)) return;
    const double v = bracketed_root([&](double u) { return f.at(u); }, 0, 1, rising);
    found(from + width * v);
    return;
  }
  Bernstein<n> left, right = f;
  for (std::size_t k = 0; k <= n; ++k) {
    left.c[k] = right.c[0];
    for (std::size_t i = 0; i + k < n; ++i) right.c[i] = 0.5 * (right.c[i] + right.c[i + 1]);
  }
  const double middle = 0.5 * (from + to);
  find_zeros(left, found, from, middle);
  find_zeros(right, found, middle, to);
}

}  // namespace isolux
