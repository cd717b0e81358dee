#pragma once

#include <numbers>

#include "formats/radiance_text.h"

namespace isolux {

inline constexpr double kDegree = std::numbers::pi / 180;
inline constexpr double kEfficacy = 179;        // lm/W, from radiance to luminance
inline constexpr double kSunAngle = 5.9803e-5;  // sr, of half a degree: 2 π (1 − cos 0.25°)

inline const std::string kThing = "m sphere thing 0 0 4 0 0 0 1\n";
inline const std::string kDome =
    "skyfunc glow above 0 0 4 1 1 1 0\nabove source sky 0 0 4 0 0 1 180\n"
    "skyfunc glow below 0 0 4 1 1 1 0\nbelow source ground 0 0 4 0 0 -1 180\n";

inline SceneFile with_sky(const std::string& text) {
  return read_radiance_text(kGray + kThing + text);
}

/// The sky of a function that makes both hemispheres.
inline Sky dome(const std::string& function) {
  return with_sky(function + "\n" + kDome).scene.sky.value();
}

/// The direction so far from the zenith and west of south, degrees.
inline Vec3 toward(double from_zenith, double west_of_south) {
  const double z = from_zenith * kDegree, a = west_of_south * kDegree;
  return {-std::sin(z) * std::sin(a), -std::sin(z) * std::cos(a), std::cos(z)};
}

inline double relative(double value, double expected) { return std::abs(value / expected - 1); }

}  // namespace isolux
