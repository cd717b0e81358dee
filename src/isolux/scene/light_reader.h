#pragma once

#include "isolux/core/color.h"
#include "isolux/geometry/shape.h"
#include "isolux/scene/value.h"

namespace isolux {

/// Reads an `emission` of the shape: its exitance in lm/m².
Rgb read_emission(const Value& emission, const Shape& shape);

}  // namespace isolux
