#include "isolux/formats/notes.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/scene/spelling.h"

namespace isolux {

constexpr std::size_t kMostLines = 100;  // more would not be read

void Notes::add(const std::string& line) {
  if (std::find(lines_.begin(), lines_.end(), line) != lines_.end()) return;
  if (lines_.size() < kMostLines) lines_.push_back(line);
}

void Notes::add(std::size_t count, std::string_view noun, std::string_view what) {
  if (count > 0) add(fmt::format("{} {}{} {}", count, noun, count == 1 ? "" : "s", what));
}

void Notes::left_out(std::string_view word, std::string_view reason) {
  add(word, " left out: ", reason);
}

void Notes::changed(std::string_view word, std::string_view into) { add(word, ": ", into); }

void Notes::add(std::string_view word, std::string_view joint, std::string_view reason) {
  auto found = std::find_if(shared_.begin(), shared_.end(), [&](const Shared& entry) {
    return entry.joint == joint && entry.reason == reason;
  });
  if (found == shared_.end()) found = shared_.insert(shared_.end(), {joint, reason, {}});
  auto& words = found->words;
  if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

std::vector<std::string> Notes::lines() const {
  std::vector<std::string> all;
  for (const auto& [joint, reason, words] : shared_) {
    all.push_back(enumerated(words) + std::string(joint) + std::string(reason));
  }
  all.insert(all.end(), lines_.begin(), lines_.end());
  return all;
}

}  // namespace isolux
