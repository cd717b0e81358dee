#include "isolux/formats/rayshade/lexer.h"

#include <fmt/format.h>

#include <charconv>

#include "isolux/formats/rayshade/macros.h"
#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool starts_word(char c) { return starts_identifier(c) || c == '/' || c == '.' || c == '~'; }
bool continues_word(char c) { return starts_word(c) || is_digit(c) || c == '-'; }
bool continues_identifier(char c) { return starts_identifier(c) || is_digit(c); }

}  // namespace

/// Goes on by one character.
void Lexer::step() {
  const bool runs = piece_ > 0 && source_.pieces[piece_ - 1].runs;
  if (runs && peek() == '\n') ++place_.line, place_.column = 0;
  if (runs) ++place_.column;
  ++at_;
}

Token Lexer::next() {
  const auto enter_piece = [&] {
    while (piece_ < source_.pieces.size() && source_.pieces[piece_].begin <= at_) {
      place_ = source_.pieces[piece_++].place;
    }
  };
  enter_piece();
  while (!at_end() && is_blank(peek())) step(), enter_piece();
  Token token{Token::Kind::end, "", 0, place_};
  if (at_end()) {
    if (token.place.file == nullptr) token.place.file = &source_.files.front();
    return token;
  }
  const std::string_view rest = std::string_view(source_.text).substr(at_);
  const bool digits = !leading_number(rest).empty();
  std::size_t size = 1;
  if (digits) {
    token.kind = Token::Kind::number;
    const auto [end, failure] =
        std::from_chars(rest.data(), rest.data() + rest.size(), token.number);
    size = static_cast<std::size_t>(end - rest.data());
    if (failure != std::errc{}) fail(place_, "this number is too large, or too near 0");
    if (size < rest.size() && (starts_identifier(rest[size]) || rest[size] == '.')) {
      fail(place_, fmt::format("{} is no number", in_quotes(leading_number(rest))));
    }
  } else if (parentheses_ > 0 ? starts_identifier(rest[0]) : starts_word(rest[0])) {
    token.kind = Token::Kind::word;
    const auto continues = parentheses_ > 0 ? continues_identifier : continues_word;
    while (size < rest.size() && continues(rest[size])) ++size;
  } else if (std::string_view("(),+-*/%^").find(rest[0]) != std::string_view::npos) {
    token.kind = Token::Kind::sign;
    parentheses_ += rest[0] == '(' ? 1 : rest[0] == ')' ? -1 : 0;
    if (parentheses_ < 0) fail(place_, "a ')' without its '('");
  } else {
    fail(place_, fmt::format("{} has no meaning here", in_quotes(rest.substr(0, 1))));
  }
  token.text = rest.substr(0, size);
  for (std::size_t i = 0; i < size; ++i) step(), enter_piece();
  return token;
}

}  // namespace isolux::rayshade
