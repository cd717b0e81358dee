#pragma once

#include <vector>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"

namespace isolux {

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

// Light in formats that count in watts, in three channels. Radiance goes to lumens by one efficacy
// and these weights (G. Ward Larson and R. Shakespeare, Rendering with Radiance, 1998); so do the
// readers of all such formats.

/// The luminance (cd/m²) of a radiance, W/(sr m²), of no negative channel; likewise the luminous
/// intensity (cd) of a radiant one and the illuminance (lx) of an irradiance. Channels keep their
/// proportions; the photometric value is 179 lm/W (0.265 R + 0.670 G + 0.065 B).
Rgb luminance_of_radiance(const Rgb& radiance);

/// The way back.
Rgb radiance_of_luminance(const Rgb& luminance);

/// The colour nearest to `color`, of the same luminance (at most `most`, at least 0) and hue, whose
/// channels lie in [0, most]: mixed with grey as far as needed.
Rgb paled_into_range(const Rgb& color, double most);

}  // namespace isolux
