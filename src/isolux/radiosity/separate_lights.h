#pragma once

#include <cstdint>
#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

/// Which objects are worth treating as lights of their own, by object (1 or 0): those whose
/// exitance is more than 1.5 × the mean radiosity of all others, estimated as their emitted flux
/// over their Σ (1 − ρ) A, and whose shape can be cut into triangles. The rest do not stand out, so
/// that rays over the hemisphere find them well; in a furnace, where every surface has the same
/// radiosity, that is all of them. Where the area of a shape is not known, that of its box stands
/// in.
std::vector<std::uint8_t> separate_lights(const Scene& scene);

}  // namespace isolux
