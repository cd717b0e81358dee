#include "isolux/scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace isolux {
namespace {

using std::numbers::pi;

/// Closer to the horizon than this, the sky is taken to be as it is here: b / cos Z has no end.
constexpr double kHorizon = 1e-3;

/// ∫ f, by midpoints that are denser towards both ends.
template <typename Function>
double integral(double from, double to, const Function& f) {
  constexpr int kSteps = 192;
  const auto place = [&](double u) { return from + (to - from) * u * u * (3 - 2 * u); };
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double width = place((i + 1.0) / kSteps) - place(double(i) / kSteps);
    sum += f(place((i + 0.5) / kSteps)) * width;
  }
  return sum;
}

}  // namespace

double SkyDistribution::gradation(double cos_z) const {
  return 1 + a * std::exp(b / std::max(cos_z, kHorizon)) + slope * cos_z;
}

double SkyDistribution::indicatrix(double cos_chi) const {
  const double chi = std::acos(std::clamp(cos_chi, -1.0, 1.0));
  return 1 + c * (std::exp(d * chi) - std::exp(d * pi / 2)) + e * cos_chi * cos_chi;
}

SkyDistribution standard_sky(int type) {
  // CIE S 011/E:2003, table 1.
  constexpr std::array<SkyDistribution, kSkyTypes> kSkies{{
      {4, -0.7, 0, -1, 0},
      {4, -0.7, 2, -1.5, 0.15},
      {1.1, -0.8, 0, -1, 0},
      {1.1, -0.8, 2, -1.5, 0.15},
      {0, -1, 0, -1, 0},
      {0, -1, 2, -1.5, 0.15},
      {0, -1, 5, -2.5, 0.3},
      {0, -1, 10, -3, 0.45},
      {-1, -0.55, 2, -1.5, 0.15},
      {-1, -0.55, 5, -2.5, 0.3},
      {-1, -0.55, 10, -3, 0.45},
      {-1, -0.32, 10, -3, 0.45},
      {-1, -0.32, 16, -3, 0.3},
      {-1, -0.15, 16, -3, 0.3},
      {-1, -0.15, 24, -2.8, 0.15},
      {0, -1, 0, -1, 0, 2},
  }};
  return kSkies.at(static_cast<std::size_t>(type - 1));
}

double Sky::relative_luminance(const Vec3& direction) const {
  return distribution.gradation(dot(direction, up)) * distribution.indicatrix(dot(direction, sun)) /
         (distribution.gradation(1) * distribution.indicatrix(dot(sun, up)));
}

Rgb Sky::luminance(const Vec3& direction) const {
  return dot(direction, up) > 0 ? zenith * relative_luminance(direction) : ground;
}

double horizontal_illuminance(const SkyDistribution& sky, double cos_sun) {
  // ∫ L cos Z dω over circles of the angle χ about the sun, as the sky changes most across them,
  // and over the azimuth ψ on each, from its highest place down to the horizon.
  const double from_zenith = std::acos(std::clamp(cos_sun, -1.0, 1.0));
  const double sin_sun = std::sin(from_zenith);
  const auto circle = [&](double chi) {
    const double middle = std::cos(chi) * cos_sun, radius = std::sin(chi) * sin_sun;
    const double horizon = std::acos(std::clamp(-middle / std::max(radius, 1e-300), -1.0, 1.0));
    const double half = integral(0, horizon, [&](double psi) {
      const double cos_z = middle + radius * std::cos(psi);
      return sky.gradation(cos_z) * std::max(0.0, cos_z);
    });
    return 2 * half * sky.indicatrix(std::cos(chi)) * std::sin(chi);
  };
  // Circles that do not cross the horizon lie above it around the sun or, where that is below,
  // around the place opposite to it.
  const double near = std::abs(pi / 2 - from_zenith);
  const double whole = cos_sun > 0 ? integral(0, near, circle) : integral(pi - near, pi, circle);
  return (whole + integral(near, pi - near, circle)) / (sky.gradation(1) * sky.indicatrix(cos_sun));
}

Rgb horizontal_illuminance(const Sky& sky) {
  return sky.zenith * horizontal_illuminance(sky.distribution, dot(sky.sun, sky.up));
}

LuminanceRange relative_range(const SkyDistribution& sky, double cos_sun) {
  // A product of φ and f is nowhere negative where neither is, and never more than both at most.
  constexpr int kSteps = 4096;
  const double farthest = std::min(pi, pi / 2 + std::acos(std::clamp(cos_sun, -1.0, 1.0)));
  LuminanceRange gradation{1, 1}, indicatrix{1, 1};
  const auto include = [](double part, LuminanceRange& range) {
    if (!std::isfinite(part)) range.most = std::numeric_limits<double>::quiet_NaN();
    range.least = std::min(range.least, part);
    if (part > range.most) range.most = part;
  };
  for (int i = 0; i <= kSteps; ++i) {
    const double u = double(i) / kSteps;
    include(sky.gradation(u) / sky.gradation(1), gradation);
    include(sky.indicatrix(std::cos(farthest * u * u)) / sky.indicatrix(cos_sun), indicatrix);
  }
  const bool negative = gradation.least < 0 || indicatrix.least < 0;
  return {
      negative ? std::min(gradation.least, indicatrix.least) : gradation.least * indicatrix.least,
      gradation.most * indicatrix.most};
}

}  // namespace isolux
