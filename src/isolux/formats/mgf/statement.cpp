#include "isolux/formats/mgf/statement.h"

#include <fmt/format.h>

#include <cmath>

#include "isolux/scene/length.h"
#include "isolux/scene/spelling.h"

namespace isolux::mgf {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }
bool is_line_end(char c) { return c == '\n' || c == '\r'; }

}  // namespace

void Statement::fail(std::size_t i, const std::string& message) const {
  throw InputError(location(i), message);
}

void Statement::expect_arguments(std::size_t least, std::size_t most,
                                 std::string_view usage) const {
  const std::size_t given = size() - 1;
  if (given < least)
    fail(0, fmt::format("{} lacks an argument: write {}", in_quotes(word(0)), usage));
  if (given > most) {
    fail(most + 1,
         fmt::format("{} is one argument too many: write {}", in_quotes(word(most + 1)), usage));
  }
}

double Statement::number(std::size_t i) const {
  const std::optional<double> value = parse_number(word(i));
  if (!value) fail(i, fmt::format("expected a number, not {}", in_quotes(word(i))));
  if (!std::isfinite(*value)) {
    fail(i, fmt::format("{} is not a finite number", in_quotes(word(i))));
  }
  return *value;
}

double Statement::number_of_at_least_0(std::size_t i) const {
  const double value = number(i);
  if (value < 0) fail(i, fmt::format("must not be negative, but is {}", value));
  return value;
}

int Statement::integer(std::size_t i, int least, int most) const {
  const double value = number(i);
  if (value != std::floor(value) || value < least || value > most) {
    fail(i, fmt::format("expected a whole number from {} to {}, not {}", least, most,
                        in_quotes(word(i))));
  }
  return static_cast<int>(value);
}

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

}  // namespace isolux::mgf
