#include "isolux/formats/object_names.h"

#include <fmt/format.h>

namespace isolux {

std::string clean_name(std::string_view word, std::string_view otherwise) {
  constexpr std::size_t kLongest = 60;
  std::string name(word.empty() ? otherwise : word.substr(0, kLongest));
  for (char& c : name) {
    if (c < ' ' || c > '~') c = '?';
  }
  return name;
}

std::string NumberedNames::next(const std::string& name) {
  std::size_t& last = last_[name];
  if (++last == 1) return name;
  std::string numbered = fmt::format("{} {}", name, last);
  while (!last_.emplace(numbered, 1).second) numbered = fmt::format("{} {}", name, ++last);
  return numbered;
}

}  // namespace isolux
