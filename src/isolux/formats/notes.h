#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace isolux {

/// What to tell about a scene that was read, each thing once.
class Notes {
 public:
  /// A line of its own; after a hundred of these, no more.
  void add(const std::string& line);
  /// "2 faces without area: left out"; nothing where there are none.
  void add(std::size_t count, std::string_view noun, std::string_view what);
  /// A word of the language that was left out; words left out for one reason share a line. Both
  /// live on.
  void left_out(std::string_view word, std::string_view reason);
  /// A word that means something else here, likewise.
  void changed(std::string_view word, std::string_view into);
  std::vector<std::string> lines() const;

 private:
  struct Shared {
    std::string_view joint, reason;
    std::vector<std::string_view> words;
  };
  void add(std::string_view word, std::string_view joint, std::string_view reason);

  std::vector<std::string> lines_;
  std::vector<Shared> shared_;
};

}  // namespace isolux
