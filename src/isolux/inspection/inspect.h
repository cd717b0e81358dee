#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// What rays find out about a scene.
struct Inspection {
  /// That light takes from lights other than the sky (eyes, where there are none) onwards; 0: there
  /// are neither.
  std::uint64_t rays = 0;
  std::uint64_t escaped = 0;  ///< of these, how many leave the scene: none where it is closed
  std::vector<std::string> warnings;  ///< each one line
};

/// Looks for what makes radiosity scenes fail (Baum, Mann, Smith and Winget, Making radiosity
/// usable, SIGGRAPH 1991): surfaces that coincide, face the wrong way, run through each other, or
/// have no area; and for lights that shine at nothing. Of each kind the first three are named. The
/// numbers of rays and their seeds are fixed: the same scene gives the same lines. Cost: n log n in
/// the objects, some thousand rays besides.
Inspection inspect_scene(const RayCaster& rays);

}  // namespace isolux
