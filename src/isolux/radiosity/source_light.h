#pragma once

#include <span>

#include "isolux/radiosity/form_factor.h"
#include "isolux/raycast/ray_caster.h"
#include "isolux/scene/sky.h"
#include "isolux/scene/source.h"

namespace isolux {

/// Adds the irradiance (lx) that a group of neighbours gets straight from a source: exact, by the
/// law of distance and cosine and one ray each; none where nothing may stand between.
void add_source_light(const RayCaster& rays, const Source& source,
                      std::span<const Receiver> receivers, std::span<Rgb> irradiance);

/// The part of a source's light that arrives at some surface's lit side, lm, by stratified rays:
/// all of it in a closed room (then exact).
double arriving_flux(const RayCaster& rays, const Source& source);

/// The same of a sky, and the ground below its horizon.
double arriving_flux(const RayCaster& rays, const Sky& sky);

}  // namespace isolux
