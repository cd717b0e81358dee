#pragma once

#include <string>

#include "isolux/core/error.h"

namespace isolux::rayshade {

/// A place in one of the scene's files; what `file` points to lives as long as the SourceText.
struct Place {
  const std::string* file = nullptr;
  int line = 1, column = 1;

  SourceLocation location() const { return {*file, line, column}; }
};

[[noreturn]] inline void fail(const Place& place, const std::string& message) {
  throw InputError(place.location(), message);
}

}  // namespace isolux::rayshade
