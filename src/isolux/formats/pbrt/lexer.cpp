#include "isolux/formats/pbrt/lexer.h"

#include <fmt/format.h>

#include <cmath>

#include "isolux/scene/length.h"
#include "isolux/scene/spelling.h"

namespace isolux::pbrt {
namespace {

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool ends_word(char c) { return is_blank(c) || c == '[' || c == ']' || c == '"' || c == '#'; }

bool begins_number(std::string_view word) {
  const char c = word[word.size() > 1 && (word[0] == '-' || word[0] == '+' || word[0] == '.')];
  return (c >= '0' && c <= '9') || c == '.';
}

}  // namespace

Token Lexer::next() {
  Token token = std::move(next_);
  read();
  return token;
}

void Lexer::read() {
  const std::string& text = source_.text;
  bool comment = false;
  for (; at_ < text.size() && (comment || is_blank(text[at_]) || text[at_] == '#'); ++at_) {
    if (text[at_] == '#') comment = true;
    if (text[at_] != '\n') continue;
    comment = false;
    ++line_;
    line_start_ = at_ + 1;
  }
  next_ = {};
  next_.where = {source_.file, line_, static_cast<int>(at_ - line_start_) + 1};
  if (at_ == text.size()) return;
  const std::size_t start = at_;
  if (text[at_] == '"') {
    at_ = text.find_first_of("\"\n", at_ + 1);
    if (at_ == std::string::npos || text[at_] == '\n') next_.fail("this text is not closed");
    next_.kind = Token::Kind::text;
    next_.text = std::string_view(text).substr(start + 1, at_++ - start - 1);
    return;
  }
  if (text[at_] == '[' || text[at_] == ']') {
    next_.kind = Token::Kind::bracket;
    ++at_;
  } else {
    next_.kind = Token::Kind::word;
    while (at_ < text.size() && !ends_word(text[at_])) ++at_;
  }
  next_.text = std::string_view(text).substr(start, at_ - start);
  if (next_.kind == Token::Kind::bracket || !begins_number(next_.text)) return;
  const auto number = parse_number(next_.text);
  if (!number || !std::isfinite(*number)) {
    next_.fail(fmt::format("{} is no finite number", in_quotes(next_.text)));
  }
  next_.kind = Token::Kind::number;
  next_.number = *number;
}

}  // namespace isolux::pbrt
