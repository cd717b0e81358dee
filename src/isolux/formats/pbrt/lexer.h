#pragma once

#include <string_view>

#include "isolux/core/error.h"
#include "isolux/formats/include_path.h"

namespace isolux::pbrt {

struct Token {
  enum class Kind { word, text, number, bracket, end };
  Kind kind = Kind::end;
  std::string_view text;  ///< without the quotes
  double number = 0;
  SourceLocation where;

  bool is(std::string_view what) const { return kind != Kind::text && text == what; }
  [[noreturn]] void fail(const std::string& message) const { throw InputError(where, message); }
};

/// Makes something; what it throws without a place gets this one. For work that reads no tokens.
template <typename Make>
auto made_at(const SourceLocation& where, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(where, error.what());
  }
}

/// Cuts a file into tokens, which refer to it.
class Lexer {
 public:
  explicit Lexer(const SourceText& source) : source_(source) { read(); }

  /// The token that comes next, not passed yet.
  const Token& peek() const { return next_; }
  Token next();

 private:
  void read();

  const SourceText& source_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  Token next_;
};

}  // namespace isolux::pbrt
