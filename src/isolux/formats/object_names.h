#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

namespace isolux {

/// A word of a file as a name in a scene: printing ASCII, not too long; `otherwise` where it is
/// empty.
std::string clean_name(std::string_view word, std::string_view otherwise = {});

/// Gives each thing a name: its own where it is the first of that name, and that with a number
/// behind it, "wall 2", from the second on. No two results are the same.
class NumberedNames {
 public:
  std::string next(const std::string& name);

 private:
  std::unordered_map<std::string, std::size_t> last_;  ///< number given to a name
};

}  // namespace isolux
