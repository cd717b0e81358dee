#pragma once

#include <span>
#include <vector>

#include "isolux/radiosity/form_factor.h"
#include "isolux/radiosity/statistics.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

class Triangulation;

/// 95 in 100 errors are smaller than so many standard deviations.
inline constexpr double kConfidence = 2;

/// Light on a point, and how wrong it may be.
struct Illumination {
  Rgb irradiance;    ///< lx
  double error = 0;  ///< of its luminance, lx: 95 in 100 are less wrong
};

/// What the receivers gather from a mesh that gather_radiosity() has lit, `solved` being what it
/// returned: straight from the lights, and by reflection with 2¼ times as many rays as its vertices
/// used on average, and more where the noise exceeds the error of the solution. Neighbours in the
/// list should be neighbours in space.
std::vector<Illumination> gather_at(const Triangulation& mesh, const RayCaster& rays,
                                    const Statistics& solved, std::span<const Receiver> receivers,
                                    std::uint64_t seed);

}  // namespace isolux
