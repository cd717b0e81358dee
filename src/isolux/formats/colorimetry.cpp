#include "isolux/formats/colorimetry.h"

#include <array>

namespace isolux {
namespace {

constexpr int kFirst = 380, kStep = 5, kLast = 780;  // nm

/// The colour-matching functions of the CIE 1931 standard colorimetric observer, (x̄, ȳ, z̄) from
/// 380 to 780 nm in steps of 5 nm (ISO/CIE 11664-1, as tabulated in CIE 15:2004).
constexpr std::array<Vec3, (kLast - kFirst) / kStep + 1> kObserver = {{
    {0.001368, 0.000039, 0.00645},
    {0.002236, 0.000064, 0.01055},
    {0.004243, 0.00012, 0.02005},
    {0.00765, 0.000217, 0.03621},
    {0.01431, 0.000396, 0.06785},
    {0.02319, 0.00064, 0.1102},
    {0.04351, 0.00121, 0.2074},
    {0.07763, 0.00218, 0.3713},
    {0.13438, 0.004, 0.6456},
    {0.21477, 0.0073, 1.03905},
    {0.2839, 0.0116, 1.3856},
    {0.3285, 0.01684, 1.62296},
    {0.34828, 0.023, 1.74706},
    {0.34806, 0.0298, 1.7826},
    {0.3362, 0.038, 1.77211},
    {0.3187, 0.048, 1.7441},
    {0.2908, 0.06, 1.6692},
    {0.2511, 0.0739, 1.5281},
    {0.19536, 0.09098, 1.28764},
    {0.1421, 0.1126, 1.0419},
    {0.09564, 0.13902, 0.81295},
    {0.05795, 0.1693, 0.6162},
    {0.03201, 0.20802, 0.46518},
    {0.0147, 0.2586, 0.3533},
    {0.0049, 0.323, 0.272},
    {0.0024, 0.4073, 0.2123},
    {0.0093, 0.503, 0.1582},
    {0.0291, 0.6082, 0.1117},
    {0.06327, 0.71, 0.07825},
    {0.1096, 0.7932, 0.05725},
    {0.1655, 0.862, 0.04216},
    {0.22575, 0.91485, 0.02984},
    {0.2904, 0.954, 0.0203},
    {0.3597, 0.9803, 0.0134},
    {0.43345, 0.99495, 0.00875},
    {0.51205, 1, 0.00575},
    {0.5945, 0.995, 0.0039},
    {0.6784, 0.9786, 0.00275},
    {0.7621, 0.952, 0.0021},
    {0.8425, 0.9154, 0.0018},
    {0.9163, 0.87, 0.00165},
    {0.9786, 0.8163, 0.0014},
    {1.0263, 0.757, 0.0011},
    {1.0567, 0.6949, 0.001},
    {1.0622, 0.631, 0.0008},
    {1.0456, 0.5668, 0.0006},
    {1.0026, 0.503, 0.00034},
    {0.9384, 0.4412, 0.00024},
    {0.85445, 0.381, 0.00019},
    {0.7514, 0.321, 0.0001},
    {0.6424, 0.265, 0.00005},
    {0.5419, 0.217, 0.00003},
    {0.4479, 0.175, 0.00002},
    {0.3608, 0.1382, 0.00001},
    {0.2835, 0.107, 0},
    {0.2187, 0.0816, 0},
    {0.1649, 0.061, 0},
    {0.1212, 0.04458, 0},
    {0.0874, 0.032, 0},
    {0.0636, 0.0232, 0},
    {0.04677, 0.017, 0},
    {0.0329, 0.01192, 0},
    {0.0227, 0.00821, 0},
    {0.01584, 0.005723, 0},
    {0.011359, 0.004102, 0},
    {0.008111, 0.002929, 0},
    {0.00579, 0.002091, 0},
    {0.004109, 0.001484, 0},
    {0.002899, 0.001047, 0},
    {0.002049, 0.00074, 0},
    {0.00144, 0.00052, 0},
    {0.001, 0.000361, 0},
    {0.00069, 0.000249, 0},
    {0.000476, 0.000172, 0},
    {0.000332, 0.00012, 0},
    {0.000235, 0.000085, 0},
    {0.000166, 0.00006, 0},
    {0.000117, 0.000042, 0},
    {0.000083, 0.00003, 0},
    {0.000059, 0.000021, 0},
    {0.000042, 0.000015, 0},
}};

/// The observer at a wavelength between kFirst and kLast, linear in between.
Vec3 observer(double wavelength) {
  const double place = (wavelength - kFirst) / kStep;
  const auto i = std::min(static_cast<std::size_t>(place), kObserver.size() - 2);
  const double w = place - static_cast<double>(i);
  return kObserver[i] * (1 - w) + kObserver[i + 1] * w;
}

/// ∫ power(λ) (x̄, ȳ, z̄)(λ) dλ, by sums at every nanometre, over ∫ ȳ dλ.
template <typename Power>
Vec3 integrate(const Power& power) {
  Vec3 sum;
  double white = 0;
  for (int wavelength = kFirst; wavelength <= kLast; ++wavelength) {
    const Vec3 seen = observer(wavelength);
    sum += seen * power(wavelength);
    white += seen.y;
  }
  return sum / white;
}

constexpr double kWhiteEfficacy = 179;  // lm/W

/// How bright Radiance finds a colour; white is 1.
double radiance_brightness(const Rgb& color) {
  return 0.265 * color.r + 0.670 * color.g + 0.065 * color.b;
}

}  // namespace

Vec3 xyz_of_chromaticity(double x, double y) { return {x / y, 1, (1 - x - y) / y}; }

Vec3 xyz_of_spectrum(double first, double last, const std::vector<double>& values) {
  const double step = (last - first) / static_cast<double>(values.size() - 1);
  return integrate([&](double wavelength) {
    if (wavelength < first || wavelength > last) return 0.0;
    const double place = (wavelength - first) / step;
    const auto i = std::min(static_cast<std::size_t>(place), values.size() - 2);
    const double w = place - static_cast<double>(i);
    return values[i] * (1 - w) + values[i + 1] * w;
  });
}

Vec3 xyz_of_black_body(double temperature) {
  // Planck's law, as a multiple of its value far in the infrared; c2 = h c / k (CODATA 2018), nm K.
  // The common factor e^(c2 / λ T) at the last wavelength is left out, lest cold bodies underflow.
  constexpr double c2 = 1.438776877e7;
  const Vec3 xyz = integrate([=](double wavelength) {
    const double exponent = c2 / (wavelength * temperature);
    const double at_last = c2 / (kLast * temperature);
    return std::pow(kLast / wavelength, 5) * std::exp(at_last - exponent) / -std::expm1(-exponent);
  });
  return xyz / xyz.y;
}

Rgb rec709(const Vec3& xyz) {
  // The linear Bradford adaptation (ICC.1:2022, annex E) of equal-energy white to D65, then XYZ to
  // the primaries of ITU-R BT.709. It keeps luminance only roughly, which is mended
  // afterwards.
  constexpr std::array<Vec3, 3> kRows = {Vec3{3.1466577, -1.6664638, -0.4801939},
                                         Vec3{-0.9955216, 1.9557567, 0.0397649},
                                         Vec3{0.0635948, -0.2145632, 1.1509684}};
  const Rgb color{dot(kRows[0], xyz), dot(kRows[1], xyz), dot(kRows[2], xyz)};
  const double found = luminance(color);
  return found > 0 ? color * (xyz.y / found) : gray(xyz.y);
}

Rgb luminance_of_radiance(const Rgb& radiance) {
  const double bright = radiance_brightness(radiance), seen = luminance(radiance);
  return bright > 0 && seen > 0 ? radiance * (kWhiteEfficacy * (bright / seen)) : Rgb{};
}

Rgb radiance_of_luminance(const Rgb& color) {
  const double bright = radiance_brightness(color), seen = luminance(color);
  return bright > 0 && seen > 0 ? color * (seen / bright / kWhiteEfficacy) : Rgb{};
}

Rgb paled_into_range(const Rgb& color, double most) {
  const double grey = std::clamp(luminance(color), 0.0, most);
  double kept = 1;  // of the distance from grey
  for (const double channel : {color.r, color.g, color.b}) {
    if (channel < 0) kept = std::min(kept, grey / (grey - channel));
    if (channel > most) kept = std::min(kept, (most - grey) / (channel - grey));
  }
  if (kept == 1) return color;
  const Rgb paled = gray(grey) + (color - gray(grey)) * kept;
  return {std::clamp(paled.r, 0.0, most), std::clamp(paled.g, 0.0, most),
          std::clamp(paled.b, 0.0, most)};
}

}  // namespace isolux
