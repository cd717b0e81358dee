#pragma once

#include <optional>
#include <span>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"
#include "isolux/solution/solution.h"

namespace isolux {

/// Where to measure: on a surface or anywhere in space.
struct MeasurePoint {
  Vec3 position;  ///< m
  Vec3 normal;    ///< unit length: which way the meter faces
};

struct Measurement {
  MeasurePoint at;
  Rgb irradiance;  ///< lx per channel
  /// Of the illuminance, lx: 95 in 100 are less wrong. Not known for solves by shooting.
  std::optional<double> error;

  double illuminance() const { return luminance(irradiance); }  ///< lx
};

/// The irradiance at each point, gathered from the whole solution with visibility by rays to the
/// true geometry; in the order of the points, the same on any number of threads. Throws
/// InputError, with the number of the point, where one lies farther from the scene than 1000 times
/// its size, for its coordinates are hardly in metres then.
std::vector<Measurement> measure(const Solution& solution, std::span<const MeasurePoint> points);

}  // namespace isolux
