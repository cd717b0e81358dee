#pragma once

#include <memory>
#include <string_view>

#include "isolux/formats/rayshade/place.h"

namespace isolux::rayshade {

/// Makes a shape; what its constructor has against the numbers is reported at that place.
template <typename T, typename... Numbers>
std::shared_ptr<const T> make(const Place& place, std::string_view word, Numbers&&... numbers) {
  try {
    return std::make_shared<T>(std::forward<Numbers>(numbers)...);
  } catch (const InputError& error) {
    fail(place, "'" + std::string(word) + "' can't be made: " + error.what());
  }
}

}  // namespace isolux::rayshade
