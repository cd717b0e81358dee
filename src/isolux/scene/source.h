#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"

namespace isolux {

/// A light without a surface: too small, or too far away, for its size to matter.
struct Source {
  enum class Kind {
    point,        ///< light spreads from `position`
    directional,  ///< light comes from infinity, all of it along `direction`
  };
  std::string name;
  Kind kind = Kind::point;
  Vec3 position;  ///< m
  Vec3 direction = {0, 0,
                    -1};  ///< unit length: the middle of a point's beam, or the way of the light
  /// Of a point, the luminous intensity in the middle of its beam, cd; of directional light, the
  /// illuminance of a surface across it, lx.
  Rgb intensity;
  /// A point's beam is full to this angle off its middle (degrees) and ends at that one; in between
  /// it falls as the square of (cos θ − cos dark) / (cos full − cos dark), the law of glTF's
  /// KHR_lights_punctual.
  double full_angle = 180;
  double dark_angle = 180;

  /// Their cosines.
  double cos_full() const { return std::cos(full_angle * (std::numbers::pi / 180)); }
  double cos_dark() const { return std::cos(dark_angle * (std::numbers::pi / 180)); }

  /// The part of the intensity that goes along `way`, of unit length, from a point.
  double beam(const Vec3& way) const;
};

/// What a point emits, lm; 0 for directional light, whose flux depends on what it meets.
double luminous_flux(const Source& source);

}  // namespace isolux
