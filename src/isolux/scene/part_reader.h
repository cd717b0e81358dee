#pragma once

#include "isolux/scene/scene.h"
#include "isolux/scene/value.h"

namespace isolux {

// Parts of scenes as the native format spells them; other files may have them too.

/// A `reflectance`: each channel at least 0 and less than 1.
Rgb read_reflectance(const Value& reflectance);

/// An entry of `cameras`.
Camera read_camera(const Value& name, const Value& value);

}  // namespace isolux
