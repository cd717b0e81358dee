#pragma once

#include "isolux/radiosity/gathering_state.h"
#include "isolux/radiosity/options.h"
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
/// InputError where there is no light.
void gather_radiosity(GatheringState& state, const RayCaster& rays, const Options& options,
                      const GatheringCallbacks& callbacks);

/// The rules of a triangulation that gather_radiosity() refines: δ goes with the size of the scene,
/// and there is no least area.
Rules gathering_rules(const Scene& scene);

}  // namespace isolux
