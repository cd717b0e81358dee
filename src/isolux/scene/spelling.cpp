#include "isolux/scene/spelling.h"

#include <fmt/format.h>

#include <algorithm>

namespace isolux {
namespace {

constexpr std::size_t kLongestWord = 64;   ///< longer ones aren't compared
constexpr std::size_t kLongestQuote = 60;  ///< bytes
constexpr std::size_t kLongestList = 20;   ///< words

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

}  // namespace

std::optional<std::string_view> nearest_name(std::string_view word,
                                             const std::vector<std::string_view>& candidates) {
  if (word.size() > kLongestWord) return std::nullopt;
  std::optional<std::string_view> nearest;
  std::size_t least = word.size() / 3 + 2;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongestWord) continue;
    const std::size_t edits = edit_distance(word, candidate);
    // A word of which nothing is left after the edits was not misspelt but another.
    if (edits < least && edits < std::max(word.size(), candidate.size())) {
      least = edits;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates) {
  if (const auto nearest = nearest_name(word, candidates)) {
    return fmt::format("did you mean {}?", in_quotes(*nearest));
  }
  if (candidates.empty()) return "there are none";
  return fmt::format("use {}{}", candidates.size() > 1 ? "one of " : "", enumerated(candidates));
}

std::string in_quotes(std::string_view text) {
  std::string shown(text.substr(0, kLongestQuote));
  if (text.size() > kLongestQuote) {
    // Not in the middle of a UTF-8 sequence.
    while (!shown.empty() && (text[shown.size()] & 0xc0) == 0x80) shown.pop_back();
    shown += "...";
  }
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return fmt::format("'{}'", shown);
}

std::string enumerated(const std::vector<std::string_view>& words) {
  const std::size_t shown = std::min(words.size(), kLongestList);
  std::string list;
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) list += i + 1 == words.size() ? " and " : ", ";
    list += in_quotes(words[i]);
  }
  return shown < words.size() ? list + ", ..." : list;
}

}  // namespace isolux
