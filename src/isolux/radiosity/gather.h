#pragma once

#include <span>

#include "isolux/core/color.h"
#include "isolux/radiosity/visibility.h"

namespace isolux {

/// Irradiance (lx) at each receiver from every triangle of the mesh, which sends out its emission
/// and the mean radiosity of its corners; visibility by rays to the true geometry, in which half
/// hidden triangles are cut at most `subdivisions` times.
void gather_irradiance(const Triangulation& mesh, const RayCaster& rays,
                       std::span<const Receiver> receivers, int subdivisions,
                       std::span<Rgb> irradiance);

}  // namespace isolux
