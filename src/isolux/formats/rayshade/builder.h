#pragma once

#include "isolux/formats/notes.h"
#include "isolux/formats/rayshade/model.h"
#include "isolux/scene/scene.h"

namespace isolux::rayshade {

/// Makes a scene of what was read.
Scene build_scene(const Model& model, Notes& notes);

}  // namespace isolux::rayshade
