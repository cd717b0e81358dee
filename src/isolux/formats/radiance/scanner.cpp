#include "isolux/formats/radiance/scanner.h"

#include <fmt/format.h>

#include <utility>

#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

constexpr std::size_t kMostArguments = 1'000'000;
constexpr std::size_t kLongestWord = 4000;
constexpr std::string_view kBlanks = " \t\f\v\r\n";
constexpr std::string_view kShellSigns = "<>;&$`()*?[]{}~";  ///< with a meaning for a shell

}  // namespace

void Primitive::expect_numbers(std::size_t least, std::size_t most, std::string_view usage) const {
  if (number_count() >= least && number_count() <= most) return;
  numbers.fail(0, fmt::format("{} takes other numbers than these {}: {}", in_quotes(type()),
                              number_count(), usage));
}

Scanner::Scanner(const SourceText& source) : source_(source), text_(source.text) {
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
}

Scanner::Scanner(const SourceText& source, const Statement::Word& part)
    : source_(source), text_(part.text), line_(part.line), column_(part.column) {}

void Scanner::step() {
  const char c = text_[at_++];
  const bool new_line = c == '\n' || (c == '\r' && (at_end() || text_[at_] != '\n'));
  new_line ? (++line_, column_ = 1) : ++column_;
}

void Scanner::pass_blanks_and_comments() {
  while (!at_end()) {
    if (text_[at_] == '#') {
      while (!at_end() && !at_line_end()) step();
    } else if (kBlanks.find(text_[at_]) != kBlanks.npos) {
      step();
    } else {
      return;
    }
  }
}

void Scanner::pass_blanks_in_line() {
  while (!at_end()) {
    const std::size_t after = at_ + 1;
    const bool continued = text_[at_] == '\\' &&
                           (after == text_.size() || text_[after] == '\n' || text_[after] == '\r');
    if (continued) {
      step();
      if (!at_end()) text_.substr(at_).starts_with("\r\n") ? (step(), step()) : step();
    } else if (!at_line_end() && kBlanks.find(text_[at_]) != kBlanks.npos) {
      step();
    } else {
      return;
    }
  }
}

Statement::Word Scanner::checked(const Statement::Word& word) const {
  if (word.text.size() <= kLongestWord) return word;
  throw InputError({source_.file, word.line, word.column},
                   fmt::format("a word has at most {} characters", kLongestWord));
}

void Scanner::add_to(std::vector<Statement::Word>& words, const Statement::Word& word) const {
  if (words.size() == kMostArguments) {
    throw InputError({source_.file, word.line, word.column},
                     fmt::format("a line has at most {} words", kMostArguments));
  }
  words.push_back(word);
}

Statement::Word Scanner::quoted() {
  const char quote = text_[at_];
  const SourceLocation start{source_.file, line_, column_};
  step();
  Statement::Word word{{}, line_, column_};
  const std::size_t begin = at_;
  while (!at_end() && text_[at_] != quote) step();
  if (at_end()) throw InputError(start, "this quote is not closed");
  word.text = text_.substr(begin, at_ - begin);
  step();
  return checked(word);
}

Statement::Word Scanner::bare(std::string_view ends) {
  Statement::Word word{{}, line_, column_};
  const std::size_t begin = at_;
  while (!at_end() && ends.find(text_[at_]) == ends.npos) step();
  word.text = text_.substr(begin, at_ - begin);
  return checked(word);
}

std::optional<Statement::Word> Scanner::word() {
  pass_blanks_and_comments();
  if (at_end()) return std::nullopt;
  return text_[at_] == '"' || text_[at_] == '\'' ? quoted() : bare(kBlanks);
}

std::optional<Statement> Scanner::line() {
  std::vector<Statement::Word> words;
  pass_blanks_in_line();
  if (at_end()) return std::nullopt;
  for (; !at_end() && !at_line_end(); pass_blanks_in_line()) {
    if (text_[at_] == '#') {
      while (!at_end() && !at_line_end()) step();
      break;
    }
    add_to(words, text_[at_] == '"' || text_[at_] == '\'' ? quoted() : bare(kBlanks));
  }
  if (!at_end()) step();
  return Statement(source_.file, std::move(words));
}

Command Scanner::command() {
  Command command;
  std::vector<Statement::Word> words;
  const auto end_stage = [&] {
    if (words.empty()) {
      throw InputError({source_.file, line_, column_}, "a program must stand here");
    }
    command.stages.emplace_back(source_.file, std::exchange(words, {}));
  };
  step();
  for (pass_blanks_in_line(); !at_end() && !at_line_end(); pass_blanks_in_line()) {
    if (text_[at_] == '|') {
      end_stage();
      step();
    } else if (text_[at_] == '"' || text_[at_] == '\'') {
      add_to(words, quoted());
      // A shell would join what follows without a blank.
      command.plain &= at_end() || text_[at_] == '|' || kBlanks.find(text_[at_]) != kBlanks.npos;
    } else {
      const Statement::Word word = bare(" \t\f\v\r\n|");
      const bool signs = word.text.find_first_of(kShellSigns) != word.text.npos;
      const bool joined = word.text.find_first_of("\"'\\") != word.text.npos;
      command.plain &= !signs && !joined;
      add_to(words, word);
    }
  }
  end_stage();
  return command;
}

Statement::Word Scanner::required_word(const Statement::Word& after, std::string_view what) {
  const auto next = word();
  if (next) return *next;
  throw InputError({source_.file, after.line, after.column},
                   fmt::format("the file ends after {}: {}", in_quotes(after.text), what));
}

Statement Scanner::arguments(const Statement::Word& name, std::string_view what) {
  const Statement::Word count_word =
      required_word(name, "a primitive has three lists of arguments, each headed by its length");
  std::vector<Statement::Word> words{count_word};
  const Statement count(source_.file, words);
  const double length = count.number(0);
  if (!(length >= 0 && length <= kMostArguments && length == static_cast<int>(length))) {
    count.fail(0, fmt::format("expected how many {} follow, from 0 to {}, not {}", what,
                              kMostArguments, in_quotes(count_word.text)));
  }
  for (int i = 0; i < static_cast<int>(length); ++i) {
    const auto next = word();
    if (!next) {
      count.fail(0, fmt::format("of these {} {}, there are only {} before the end of the file",
                                length, what, i));
    }
    words.push_back(*next);
  }
  return Statement(source_.file, std::move(words));
}

Primitive Scanner::primitive() {
  constexpr std::string_view kUsage = "a primitive begins with its modifier, type and name";
  std::vector<Statement::Word> head;
  head.push_back(*word());
  head.push_back(required_word(head.back(), kUsage));
  head.push_back(required_word(head.back(), kUsage));
  const Statement::Word type = head[1], name = head[2];
  Statement first(source_.file, std::move(head));
  if (type.text == "alias") {
    const Statement::Word target = required_word(name, "an alias needs a name to stand for");
    const Statement none(source_.file, {type});
    return {std::move(first), Statement(source_.file, {type, target}), none};
  }
  Statement strings = arguments(name, "words");
  const Statement integers = arguments(name, "whole numbers");
  for (std::size_t i = 1; i < integers.size(); ++i) integers.number(i);
  Statement numbers = arguments(name, "numbers");
  for (std::size_t i = 1; i < numbers.size(); ++i) numbers.number(i);
  return {std::move(first), std::move(strings), std::move(numbers)};
}

std::optional<std::variant<Primitive, Command>> Scanner::next() {
  pass_blanks_and_comments();
  if (at_end()) return std::nullopt;
  if (text_[at_] == '!') return command();
  return primitive();
}

}  // namespace isolux::radiance
