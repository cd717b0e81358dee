#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// From where the rays met an object's surface.
struct Sight {
  std::uint32_t front = 0, back = 0;
};

/// Of the rays that leave a light.
struct Shine {
  std::uint32_t rays = 0;
  /// Those that meet a side that takes no part or, unless the scene has a sky, nothing.
  std::uint32_t lost = 0;
};

/// What random walks found that begin at the lights and at the cameras' eyes and go on, wherever
/// they meet a surface that light leaves, in a direction with the density of diffuse light.
struct LightWalks {
  std::uint64_t rays = 0;  ///< of the walks that begin at lights; at cameras, where there are none
  std::uint64_t escaped = 0;  ///< of these, how many leave the scene
  bool open = false;          ///< whether any ray leaves it, those from cameras included
  std::vector<Sight> sights;  ///< by object
  std::vector<Shine> shines;  ///< by object, then by source; zero for those without light
};

/// Traces a fixed number of walks. `points`, by object, are on its surface (points_on_objects()).
/// Deterministic.
LightWalks walk_with_light(const RayCaster& rays, std::span<const std::vector<Hit>> points);

}  // namespace isolux
