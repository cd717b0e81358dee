#pragma once

#include <optional>
#include <string>
#include <vector>

#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// What rays find out about a scene.
struct Inspection {
  /// The share of rays that leave the scene, of those that light takes from lights (or eyes)
  /// onwards: 0 where it is closed. Nothing where there is neither light nor camera.
  std::optional<double> escaping;
  std::vector<std::string> warnings;  ///< each one line
};

/// Looks for what makes radiosity scenes fail (Baum, Mann, Smith and Winget, Making radiosity
/// usable, SIGGRAPH 1991): surfaces that coincide, face the wrong way, run through each other, or
/// have no area; and for lights that shine at nothing. Of each kind the first three are named. The
/// numbers of rays and their seeds are fixed: the same scene gives the same lines. Cost: n log n in
/// the objects, some thousand rays besides.
Inspection inspect_scene(const RayCaster& rays);

}  // namespace isolux
