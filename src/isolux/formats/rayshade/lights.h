#pragma once

#include "isolux/formats/notes.h"
#include "isolux/formats/rayshade/model.h"
#include "isolux/scene/scene.h"

namespace isolux::rayshade {

/// The extent of a scene without its lights.
struct Extent {
  Vec3 middle;      ///< m, of all that is finite
  double size = 0;  ///< m, the diagonal of all, the eye included
};

/// Adds the lights: sources for points, spots and directional lights, shining surfaces for extended
/// and area lights.
///
/// In Rayshade a light of intensity I makes a surface that faces it appear as I times its diffuse
/// color, however far it is. That appearance is read as luminance in cd/m², which asks for an
/// illuminance of π I lx. Light here spreads, so that it is π I at the middle of the scene only.
void add_lights(const std::vector<Light>& lights, const Extent& extent, Scene& scene, Notes& notes);

}  // namespace isolux::rayshade
