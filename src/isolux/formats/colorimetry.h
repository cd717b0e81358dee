#pragma once

#include <vector>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"

namespace isolux {

/// The luminous efficacy of white light by which Radiance converts (Ward 1994), lm/W: how readers
/// and writers of formats that count in watts do too.
inline constexpr double kWhiteEfficacy = 179;

// Colours as CIE 1931 tristimulus values (X, Y, Z), and as linear Rec. 709. Neutral is the
// equal-energy white, X = Y = Z, which becomes the white of Rec. 709, r = g = b, as a surface that
// reflects all wavelengths alike is grey.

/// The colour of chromaticity (x, y) and Y = 1; y > 0.
Vec3 xyz_of_chromaticity(double x, double y);

/// The colour of a spectrum of power per wavelength: at least two values, evenly spaced from
/// `first` to `last` (nm, first < last), linear in between and zero outside. Scaled so that a
/// spectrum of 1 everywhere has Y = 1.
Vec3 xyz_of_spectrum(double first, double last, const std::vector<double>& values);

/// The colour of a black body of that temperature (K, > 0), Y = 1.
Vec3 xyz_of_black_body(double temperature);

/// The colour in linear Rec. 709, of luminance Y; channels are negative where it is more saturated
/// than the primaries.
Rgb rec709(const Vec3& xyz);

/// The colour nearest to `color`, of the same luminance (at most `most`, at least 0) and hue, whose
/// channels lie in [0, most]: mixed with grey as far as needed.
Rgb paled_into_range(const Rgb& color, double most);

}  // namespace isolux
