#pragma once

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"

namespace isolux {

// Notation (CIE S 011/E:2003; the sky of Perez, Seals & Michalsky 1993 has the same form)
//   Z, Z_s   angle from the zenith: of a direction, of the sun
//   χ        angle from the sun
//   φ, f     gradation and indicatrix: the luminance of the sky goes with φ(Z) f(χ)

/// How the luminance of a sky goes with the direction:
/// φ(Z) = 1 + a exp(b / cos Z) + slope cos Z, f(χ) = 1 + c (exp(d χ) − exp(d π/2)) + e cos² χ.
struct SkyDistribution {
  double a = 0, b = -1, c = 0, d = -1, e = 0;
  double slope = 0;  ///< 2 for the overcast sky of Moon and Spencer, 0 for all others

  bool operator==(const SkyDistribution&) const = default;

  /// Whether it matters where the sun is.
  bool depends_on_sun() const { return c != 0 || e != 0; }

  double gradation(double cos_z) const;
  double indicatrix(double cos_chi) const;
};

/// The standard skies of the CIE: types 1 to 15, and 16, the overcast sky of Moon and Spencer.
inline constexpr int kSkyTypes = 16;

/// The sky of that type, 1 … kSkyTypes.
SkyDistribution standard_sky(int type);

// What skies may be, far beyond those of the standard: coefficients, and the luminance relative to
// that in the zenith; cd/m², nearly that of the sun.
inline constexpr double kLargestSkyCoefficient = 100, kLargestContrast = 500;
inline constexpr double kBrightestSky = 1e9;

/// The sky around a scene and the ground below its horizon, both infinitely far away. The sun's
/// disk is not part of it: that is a directional source.
struct Sky {
  SkyDistribution distribution;
  Vec3 up{0, 0, 1};   ///< to the zenith, unit length
  Vec3 sun{0, 0, 1};  ///< towards the sun, unit length
  Rgb zenith;         ///< luminance in the zenith, cd/m²
  Rgb ground;         ///< luminance of all that lies below the horizon, cd/m²

  bool shines() const { return max_channel(zenith) > 0 || max_channel(ground) > 0; }

  /// The luminance of the sky in a direction of unit length above the horizon, in parts of that in
  /// the zenith.
  double relative_luminance(const Vec3& direction) const;

  /// The luminance in a direction of unit length, cd/m².
  Rgb luminance(const Vec3& direction) const;
};

/// The illuminance of an open horizontal surface by a sky whose luminance is 1 cd/m² in the zenith,
/// lx; to 1e-4, also where the sky falls off from the sun as steeply as with d = −100.
double horizontal_illuminance(const SkyDistribution& distribution, double cos_sun);
/// That of a surface under this sky, by the sky alone, lx.
Rgb horizontal_illuminance(const Sky& sky);

/// What the luminance of a sky stays within, in parts of that in the zenith: not finite where the
/// zenith has none, `least` negative where the sky is so anywhere.
struct LuminanceRange {
  double least, most;
};
LuminanceRange relative_range(const SkyDistribution& distribution, double cos_sun);

}  // namespace isolux
