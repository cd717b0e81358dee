#pragma once

#include "isolux/scene/scene.h"

namespace isolux {

/// The axis that points up, 2 for z or 1 for y. It is z, by custom, but y where the lights lie in
/// the upper half of the scene's height along y and higher, as a part of it, than along z: lamps
/// hang from ceilings. (A light's place counts by its flux.)
int guessed_up_axis(const Scene& scene);

/// A camera named "default" that sees a scene which has none. Where the scene is a room (closed or
/// open on one side, at least half a metre high) it stands in the corner that has the widest view,
/// at eye height, and looks at the middle; else outside, where it sees everything. `up` is the axis
/// that points up. Takes time in proportion to the objects.
Camera default_camera(const Scene& scene, int up);
/// The same with the axis guessed.
Camera default_camera(const Scene& scene);

}  // namespace isolux
