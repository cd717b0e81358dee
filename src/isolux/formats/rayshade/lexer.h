#pragma once

#include <string_view>

#include "isolux/formats/rayshade/preprocessor.h"

namespace isolux::rayshade {

struct Token {
  enum class Kind { word, number, sign, end };  ///< sign: one of ( ) , + - * / % ^
  Kind kind = Kind::end;
  std::string_view text;  ///< in the SourceText
  double number = 0;
  Place place;

  bool is(std::string_view what) const { return kind != Kind::number && text == what; }
};

/// Cuts a text into tokens. Between parentheses words are variables and functions, of letters,
/// digits and _; elsewhere they are keywords and names, which may have . / - ~ as well.
class Lexer {
 public:
  explicit Lexer(const SourceText& source) : source_(source) {}
  Token next();

 private:
  bool at_end() const { return at_ == source_.text.size(); }
  char peek() const { return source_.text[at_]; }
  void step();

  const SourceText& source_;
  std::size_t at_ = 0, piece_ = 0;
  int parentheses_ = 0;
  Place place_;
};

}  // namespace isolux::rayshade
