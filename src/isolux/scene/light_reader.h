#pragma once

#include "isolux/core/color.h"
#include "isolux/geometry/shape.h"
#include "isolux/scene/source.h"
#include "isolux/scene/value.h"

namespace isolux {

/// Reads an `emission` of the shape: its exitance in lm/m².
Rgb read_emission(const Value& emission, const Shape& shape);
/// The same for a part of a shape, whose area is not known.
Rgb read_emission(const Value& emission);

/// Reads an amount of light under `key`, not negative: three channels, or a number whose
/// proportions a `color` may set.
Rgb read_amount(const Fields& fields, std::string_view key);

/// Reads an item of `lights`; one without a name gets its kind and `number`.
Source read_source(const Value& light, std::size_t number);

}  // namespace isolux
