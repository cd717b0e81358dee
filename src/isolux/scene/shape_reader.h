#pragma once

#include <memory>
#include <string_view>

#include "isolux/geometry/shape.h"
#include "isolux/scene/value.h"

namespace isolux {

/// A shape and the key it was written under, such as "sphere".
struct ReadShape {
  std::string_view kind;
  std::shared_ptr<const Shape> shape;
};

/// Reads a shape: a map of one shape key, and perhaps a `transform`.
ReadShape read_shape(const Value& value);

/// The shape under the `transform` among the fields, if there is one.
std::shared_ptr<const Shape> transformed(std::shared_ptr<const Shape> shape, const Fields& fields);

}  // namespace isolux
