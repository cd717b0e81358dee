#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace isolux {

/// A name as one word for formats that take no others: a letter, then letters, digits, '_', '-' and
/// '.'; whatever else there was becomes '_'.
std::string identifier(std::string_view name);

/// Gives each thing an identifier of its own, as near to its name as may be.
class Identifiers {
 public:
  /// `reserved` is given to none.
  explicit Identifiers(std::unordered_set<std::string> reserved = {})
      : taken_(std::move(reserved)) {}

  std::string next(std::string_view name);

 private:
  std::unordered_set<std::string> taken_;
  std::unordered_map<std::string, std::size_t> last_;  ///< number added to a name
};

}  // namespace isolux
