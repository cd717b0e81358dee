#pragma once

#include <string>

#include "isolux/scene/scene.h"

namespace isolux {

/// The scene in the native format (docs/scene-format.md), in metres, laid out for people to go on
/// from. Read back, it has the same surfaces, materials, light and cameras, and is written in the
/// same way again; numbers keep every bit. Materials and cameras whose names are empty, repeated or
/// very long get others. It can be read back where all numbers are within what read_scene() allows.
std::string write_scene(const Scene& scene);

}  // namespace isolux
