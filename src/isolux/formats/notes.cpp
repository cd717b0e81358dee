#include "isolux/formats/notes.h"

#include <algorithm>

#include "isolux/scene/spelling.h"

namespace isolux {

void Notes::add(const std::string& line) {
  if (std::find(lines_.begin(), lines_.end(), line) == lines_.end()) lines_.push_back(line);
}

void Notes::left_out(std::string_view word, std::string_view reason) {
  auto found = std::find_if(reasons_.begin(), reasons_.end(),
                            [&](const auto& entry) { return entry.first == reason; });
  if (found == reasons_.end()) found = reasons_.insert(reasons_.end(), {reason, {}});
  auto& words = found->second;
  if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
}

std::vector<std::string> Notes::lines() const {
  std::vector<std::string> all;
  for (const auto& [reason, words] : reasons_) {
    all.push_back(enumerated(words) + " left out: " + std::string(reason));
  }
  all.insert(all.end(), lines_.begin(), lines_.end());
  return all;
}

}  // namespace isolux
