#pragma once

#include <string>
#include <vector>

#include "isolux/formats/identifiers.h"
#include "isolux/scene/scene.h"

namespace isolux::radiance {

/// The light that comes from infinity, as primitives of Radiance, which has functions for such
/// skies: its sun-like sources half a degree wide, the sky a glow over half of all directions,
/// the ground another below. Modifiers get names from `names`. Notes a sky that has no form there.
std::string light_from_infinity(const Scene& scene, Identifiers& names,
                                std::vector<std::string>& notes);

}  // namespace isolux::radiance
