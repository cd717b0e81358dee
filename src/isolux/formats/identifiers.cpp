#include "isolux/formats/identifiers.h"

#include <fmt/format.h>

namespace isolux {
namespace {

constexpr std::size_t kLongest = 100;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

std::string identifier(std::string_view name) {
  std::string word(name.substr(0, kLongest));
  for (char& c : word) {
    const bool kept = is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
    if (!kept) c = '_';
  }
  return !word.empty() && is_letter(word.front()) ? word : "x" + word;
}

std::string Identifiers::next(std::string_view name) {
  const std::string word = identifier(name);
  std::string fresh = word;
  while (!taken_.insert(fresh).second) {
    std::size_t& number = last_.try_emplace(word, 1).first->second;
    fresh = fmt::format("{}_{}", word, ++number);
  }
  return fresh;
}

}  // namespace isolux
