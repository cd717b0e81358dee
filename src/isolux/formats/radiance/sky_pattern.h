#pragma once

#include <optional>

#include "isolux/core/affine.h"
#include "isolux/formats/radiance/scanner.h"
#include "isolux/scene/sky.h"

namespace isolux::radiance {

/// The solid angle of a cone so many degrees wide, sr.
double solid_angle(double degrees);

/// A pattern that makes the sky of a glow: the radiance of the glow times a function of the
/// direction. Radiance comes with two such functions (gensky(1), gendaylit(1)), skybr of
/// skybright.cal and skybright of perezlum.cal.
struct SkyPattern {
  enum class Kind { clear, overcast, uniform, intermediate, perez };
  Kind kind = Kind::uniform;
  double factor = 1;         ///< skybr: radiance in the zenith; perez: of the whole distribution
  double ground = 0;         ///< radiance of what lies below the horizon
  double normalization = 1;  ///< skybr, with a sun: the function before it is divided by this
  /// Perez: 1 + a exp(b / cos Z), and c, d, e of 1 + c exp(d χ) + e cos² χ, which is not the
  /// indicatrix of the CIE but proportional to one.
  SkyDistribution perez;
  Vec3 up{0, 0, 1}, sun{0, 0, 1};  ///< unit length, in the world
  bool colored = false;            ///< has a color of its own, which is not kept
};

/// The pattern as it is where `map` moves it. Nothing where it is no such sky; throws InputError
/// with the place where it is one with other numbers.
std::optional<SkyPattern> read_sky_pattern(const Primitive& primitive, const Affine& map);

/// A sky whose luminances are what a pattern multiplies those of its glow by.
struct PatternedSky {
  Sky sky;
  int nearest_type = 0;  ///< of the standard sky that stands for one of another form, else 0
};

/// Nothing where the sky would be darker than 0 in places, or not finite.
///
/// Radiance's clear sky is type 12 of the CIE, its overcast sky type 16. Its intermediate sky has
/// another form, and becomes the standard sky whose luminance is nearest (least squares over
/// cos Z dω) at the same horizontal illuminance.
std::optional<PatternedSky> sky_of(const SkyPattern& pattern);

}  // namespace isolux::radiance
