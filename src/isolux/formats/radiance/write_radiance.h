#pragma once

#include "isolux/formats/written_scene.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// The scene as primitives of Radiance (Ward 1994). Spheres, cylinders, cones and disks stay what
/// they are, all else becomes polygons; the radiance of a light is that of luminance_of_radiance().
/// Throws InputError that names the object where that can't be done.
WrittenScene write_radiance(const Scene& scene);

}  // namespace isolux
