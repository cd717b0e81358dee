#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace isolux {

/// What to tell about a scene that was read, each thing once.
class Notes {
 public:
  /// A line of its own.
  void add(const std::string& line);
  /// A word of the language that was left out; words left out for one reason share a line. Both
  /// live on.
  void left_out(std::string_view word, std::string_view reason);
  std::vector<std::string> lines() const;

 private:
  std::vector<std::string> lines_;
  std::vector<std::pair<std::string_view, std::vector<std::string_view>>> reasons_;
};

}  // namespace isolux
