#pragma once

#include "isolux/formats/written_scene.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// The luminous efficacy by which Radiance converts its white light, lm/W.
inline constexpr double kRadianceEfficacy = 179;

/// The scene as primitives of Radiance (Ward 1994). Spheres, cylinders, cones and disks stay what
/// they are, all else becomes polygons; lights have a radiance of exitance / π / 179 lm/W in each
/// channel, W/(sr m²). Throws InputError that names the object where that can't be done.
WrittenScene write_radiance(const Scene& scene);

}  // namespace isolux
