#pragma once

#include <stdexcept>
#include <string>

namespace isolux {

/// A place in a text file; line and column count from 1, 0 where not known.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
};

/// What the user gave can't be used: `what()` is one line that names the place
/// (`file:line:column: `, as far as known), what is wrong and how to mend it.
/// Every other exception that leaves the library is a fault of ours.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const SourceLocation& where, const std::string& message);
};

}  // namespace isolux
