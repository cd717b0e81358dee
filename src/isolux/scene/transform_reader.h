#pragma once

#include "isolux/core/affine.h"
#include "isolux/scene/value.h"

namespace isolux {

/// Reads a `transform`: a list of steps (translate, rotate, scale, matrix), applied in its order.
/// The map is invertible.
Affine read_transform(const Value& steps);

}  // namespace isolux
