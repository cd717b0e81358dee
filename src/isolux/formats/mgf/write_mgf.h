#pragma once

#include "isolux/formats/written_scene.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// The scene in the Materials and Geometry Format (Ward 1995). Spheres, cylinders, cones, disks and
/// tori stay what they are, all else becomes faces; emitted light is `ed`, lm/m². Throws InputError
/// that names the object where that can't be done.
WrittenScene write_mgf(const Scene& scene);

}  // namespace isolux
