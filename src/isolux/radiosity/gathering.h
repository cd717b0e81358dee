#pragma once

#include <span>
#include <vector>

#include "isolux/radiosity/gathering_state.h"
#include "isolux/radiosity/options.h"
#include "isolux/radiosity/statistics.h"
#include "isolux/radiosity/visibility.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// Radiosity by gathering, to a tolerance. In place of shots over a mesh that grows where rays
/// happen to fall, surfaces are covered first; every vertex then gathers its light itself, so that
/// newborn ones are as right as old ones, and triangles are split where the light gathered at the
/// middle of an edge differs from the light interpolated there. Ends when the estimated error of
/// the illuminance is within Options::tolerance.
///
/// `state` is a new one, of an empty mesh with gathering_rules(), or as a checkpoint had it: then
/// it goes on from there, to the same bits. Afterwards each vertex has its irradiance and its
/// error, and nothing of what the triangles sent is unshot but Statistics::unshot_flux. Throws
/// InputError where no object emits.
void gather_radiosity(GatheringState& state, const RayCaster& rays, const Options& options,
                      const GatheringCallbacks& callbacks);

/// The rules of a triangulation that gather_radiosity() refines: δ goes with the size of the scene,
/// and there is no least area.
Rules gathering_rules(const Scene& scene);

/// Light on a point, and how wrong it may be.
struct Illumination {
  Rgb irradiance;    ///< lx
  double error = 0;  ///< of its luminance, lx: 95 in 100 are less wrong
};

/// What the receivers gather from a mesh that gather_radiosity() has lit, `solved` being what it
/// returned: straight from the lights, and by reflection with 2¼ times as many rays as its vertices used.
/// Neighbours in the list should be neighbours in space.
std::vector<Illumination> gather_at(const Triangulation& mesh, const RayCaster& rays,
                                    const Statistics& solved, std::span<const Receiver> receivers,
                                    std::uint64_t seed);

}  // namespace isolux
