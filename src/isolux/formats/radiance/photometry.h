#pragma once

#include "isolux/core/color.h"

namespace isolux {

// Light in Radiance is given in watts, in three channels. Its own programs go to lumens by one
// efficacy and these weights (G. Ward Larson and R. Shakespeare, Rendering with Radiance, 1998).

inline constexpr double kRadianceEfficacy = 179;  ///< lm/W, of white light

/// 0.265 R + 0.670 G + 0.065 B, as Radiance finds how bright a colour is.
double radiance_brightness(const Rgb& color);

/// The luminance (cd/m²) of a radiance in Radiance's channels, W/(sr m²). Channels keep their
/// proportions; the photometric value is 179 lm/W times the brightness.
Rgb luminance_of_radiance(const Rgb& radiance);

/// The way back.
Rgb radiance_of_luminance(const Rgb& luminance);

}  // namespace isolux
