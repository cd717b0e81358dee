#include "isolux/scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace isolux {
namespace {

using std::numbers::pi;

/// Closer to the horizon than this, the sky is taken to be as it is here: b / cos Z has no end.
constexpr double kHorizon = 1e-3;

double relative(const SkyDistribution& sky, double cos_z, double cos_chi, double cos_sun) {
  return sky.gradation(cos_z) * sky.indicatrix(cos_chi) /
         (sky.gradation(1) * sky.indicatrix(cos_sun));
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
  return relative(distribution, dot(direction, up), dot(direction, sun), dot(sun, up));
}

Rgb Sky::luminance(const Vec3& direction) const {
  return dot(direction, up) > 0 ? zenith * relative_luminance(direction) : ground;
}

double horizontal_illuminance(const SkyDistribution& distribution, double cos_sun) {
  // ∫ L cos Z dω, by midpoints of sin² Z and of the azimuth, in which cos Z dω is even.
  constexpr int kGrid = 512;
  const double sin_sun = std::sqrt(std::max(0.0, 1 - cos_sun * cos_sun));
  double sum = 0;
  for (int i = 0; i < kGrid; ++i) {
    const double squared = (i + 0.5) / kGrid;
    const double sine = std::sqrt(squared), cosine = std::sqrt(1 - squared);
    for (int j = 0; j < kGrid; ++j) {
      const double azimuth = pi * (j + 0.5) / kGrid;
      sum += relative(distribution, cosine, cosine * cos_sun + sine * sin_sun * std::cos(azimuth),
                      cos_sun);
    }
  }
  return pi * sum / (double(kGrid) * kGrid);
}

}  // namespace isolux
