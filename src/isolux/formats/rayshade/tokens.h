#pragma once

#include <deque>
#include <map>
#include <string>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"
#include "isolux/formats/rayshade/lexer.h"

namespace isolux::rayshade {

/// The tokens of a scene, read one after the other as numbers, vectors and names. Whatever is not
/// as asked for ends in an InputError with its place.
class Tokens {
 public:
  explicit Tokens(const SourceText& source);

  const Token& peek(std::size_t ahead = 0);
  Token take();
  bool next_is(std::string_view word) { return peek().is(word); }
  /// Takes the next token if it is that word.
  bool accept(std::string_view word);
  bool number_follows();
  /// Whether a word follows that is no keyword.
  bool name_follows(std::size_t ahead = 0);

  double number();  ///< finite: with a sign perhaps, or an expression in parentheses
  int integer();    ///< a number without its fraction
  Vec3 vector();
  Rgb color();                         ///< three numbers, none negative
  std::string name(const char* what);  ///< a word that is no keyword
  std::string filename();
  void skip_numbers(int count);

  /// Makes a variable of the name and number that follow.
  void define();
  /// What the variable 'time' is from here on.
  void set_time(double time) { variables_["time"] = time; }

 private:
  double expression(int precedence);
  double operand();
  double function(const Token& name);
  void expect(std::string_view sign);

  Lexer lexer_;
  std::deque<Token> ahead_;
  std::map<std::string, double, std::less<>> variables_;
  int depth_ = 0;
};

/// Whether the language gives the word a meaning, so that it is no name.
bool is_keyword(std::string_view word);

}  // namespace isolux::rayshade
