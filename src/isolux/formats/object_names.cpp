#include "isolux/formats/object_names.h"

#include <fmt/format.h>

namespace isolux {

std::string clean_name(std::string_view word) {
  constexpr std::size_t kLongest = 60;
  std::string name(word.substr(0, kLongest));
  for (char& c : name) {
    if (c < ' ' || c > '~') c = '?';
  }
  return name;
}

std::string NumberedNames::next(const std::string& name) {
  const std::size_t count = ++uses_[name];
  return count == 1 ? name : fmt::format("{} {}", name, count);
}

}  // namespace isolux
