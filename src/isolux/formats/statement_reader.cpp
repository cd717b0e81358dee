#include "isolux/formats/statement_reader.h"

namespace isolux {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

}  // namespace

void StatementReader::pass_line_end() {
  const bool carriage_return = source_.text[at_++] == '\r';
  if (carriage_return && !at_end() && source_.text[at_] == '\n') ++at_;
  ++line_;
  line_start_ = at_;
}

void StatementReader::pass_blanks() {
  const std::string& text = source_.text;
  while (!at_end()) {
    if (is_blank(text[at_])) {
      ++at_;
    } else if (text[at_] == '\\' && (at_ + 1 == text.size() || is_line_end(text[at_ + 1]))) {
      ++at_;
      if (!at_end()) pass_line_end();
    } else {
      return;
    }
  }
}

std::optional<Statement> StatementReader::next() {
  const std::string& text = source_.text;
  while (true) {
    std::vector<Statement::Word> words;
    for (pass_blanks(); !at_end() && !at_line_end(); pass_blanks()) {
      const std::size_t start = at_;
      const auto ends = [&](std::size_t i) {
        return is_blank(text[i]) || is_line_end(text[i]) ||
               (text[i] == '\\' && (i + 1 == text.size() || is_line_end(text[i + 1])));
      };
      while (!at_end() && !ends(at_)) ++at_;
      words.push_back({std::string_view(text).substr(start, at_ - start), line_,
                       static_cast<int>(start - line_start_) + 1});
    }
    if (!at_end()) {
      pass_line_end();
    } else if (words.empty()) {
      return std::nullopt;
    }
    if (!words.empty() && words[0].text[0] != '#') return Statement(source_.file, std::move(words));
  }
}

}  // namespace isolux
