#pragma once

#include <fmt/format.h>

#include <memory>

#include "isolux/geometry/shape.h"
#include "isolux/scene/spelling.h"
#include "isolux/scene/value.h"

namespace isolux {

using ShapePtr = std::shared_ptr<const Shape>;

[[noreturn]] inline void refuse_shape(const Value& place, const InputError& error) {
  place.fail(fmt::format("{} can't be made: {}", in_quotes(place.label()), error.what()));
}

/// Makes a shape; what its constructor has against the numbers is reported at `place`.
template <typename T, typename... Numbers>
ShapePtr make_shape(const Value& place, Numbers&&... numbers) {
  try {
    return std::make_shared<T>(std::forward<Numbers>(numbers)...);
  } catch (const InputError& error) {
    refuse_shape(place, error);
  }
}

/// Whether a flag is there and true.
inline bool read_flag(const Fields& fields, std::string_view key) {
  const std::optional<Value> value = fields.find(key);
  return value && value->flag();
}

}  // namespace isolux
