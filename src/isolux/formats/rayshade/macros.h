#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/formats/rayshade/place.h"

namespace isolux::rayshade {

inline bool starts_identifier(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The identifier at the beginning of the text; empty where there is none.
std::string_view leading_identifier(std::string_view text);
/// The number at the beginning of the text, with the letters that stick to it.
std::string_view leading_number(std::string_view text);

/// The macros of the C preprocessor, without its operators # and ##.
class Macros {
 public:
  /// Reads what follows '#define'.
  void define(std::string_view text, const Place& place);
  void undefine(std::string_view name) { macros_.erase(std::string(name)); }
  bool is_defined(std::string_view name) const { return macros_.contains(name); }
  /// Whether the macro of that name needs arguments.
  bool takes_arguments(std::string_view name) const;
  /// The text with all macros in it expanded, time and again; none within itself. `place` is for
  /// errors.
  std::string expand(std::string_view text, const Place& place);

 private:
  struct Macro {
    std::optional<std::vector<std::string>> parameters;
    std::string body;
    bool hidden = false;  ///< while it is being expanded
  };

  std::string call(Macro& macro, const std::vector<std::string>& arguments, const Place& place);
  void append(std::string& text, std::string_view more, const Place& place);

  std::map<std::string, Macro, std::less<>> macros_;
  std::size_t calls_ = 0, written_ = 0;
  int depth_ = 0;
};

}  // namespace isolux::rayshade
