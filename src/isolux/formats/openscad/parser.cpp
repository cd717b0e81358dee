#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>

#include "isolux/formats/openscad/tree.h"
#include "isolux/scene/spelling.h"

namespace isolux::openscad {
namespace {

constexpr int kDeepest = 200;
constexpr std::size_t kMostNodes = 1'000'000, kMostValues = 8'000'000;

bool is_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$';
}
bool is_digit(char c) { return c >= '0' && c <= '9'; }

class Parser {
 public:
  Parser(std::string_view text, Tree& tree) : rest_(text), tree_(tree) {}

  void parse() {
    for (skip_blanks(); !rest_.empty(); skip_blanks()) parse_node(tree_.nodes, 1);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { tree_.fail(place_, message); }
  [[noreturn]] void fail_expecting(std::string_view what) const {
    fail(rest_.empty() ? fmt::format("the file ends where {} should be", what)
                       : fmt::format("expected {}, not {}", what, in_quotes(rest_.substr(0, 1))));
  }
  bool at(char c) const { return !rest_.empty() && rest_.front() == c; }
  void step(std::size_t count = 1);
  void skip_blanks();
  bool take(char c);
  void expect(char c, std::string_view what) {
    if (!take(c)) fail_expecting(what);
  }
  std::string_view take_name();
  void parse_node(std::vector<Node>& siblings, int depth);
  void parse_arguments(Node& node);
  Literal parse_value(int depth);
  double parse_number();
  std::string parse_text();

  std::string_view rest_;
  Place place_;
  Tree& tree_;
  std::size_t node_count_ = 0, value_count_ = 0;
};

void Parser::step(std::size_t count) {
  for (; count > 0; --count) {
    ++place_.column;
    if (rest_.front() == '\n') ++place_.line, place_.column = 1;
    rest_.remove_prefix(1);
  }
}

/// Goes on to what is neither blank nor a comment.
void Parser::skip_blanks() {
  while (!rest_.empty()) {
    if (std::isspace(static_cast<unsigned char>(rest_.front())) != 0) {
      step();
    } else if (rest_.starts_with("//")) {
      while (!rest_.empty() && !at('\n')) step();
    } else if (rest_.starts_with("/*")) {
      const std::size_t end = rest_.find("*/", 2);
      if (end == std::string_view::npos) fail("this comment does not end: close it with */");
      step(end + 2);
    } else {
      return;
    }
  }
}

bool Parser::take(char c) {
  skip_blanks();
  if (!at(c)) return false;
  step();
  return true;
}

std::string_view Parser::take_name() {
  std::size_t size = 0;
  while (size < rest_.size() && is_name(rest_[size])) ++size;
  const std::string_view name = rest_.substr(0, size);
  step(size);
  return name;
}

void Parser::parse_node(std::vector<Node>& siblings, int depth) {
  if (depth > kDeepest) fail(fmt::format("more than {} nodes inside one another", kDeepest));
  if (++node_count_ > kMostNodes) fail(fmt::format("more than {} nodes", kMostNodes));
  bool background = false;
  for (skip_blanks(); at('%') || at('#') || at('!') || at('*'); skip_blanks()) {
    background |= at('%') || at('*');
    step();
  }
  Node node;
  node.place = place_;
  node.name = take_name();
  if (node.name.empty() || is_digit(node.name.front())) {
    place_ = node.place;
    fail_expecting("a name such as 'cube' or 'union'");
  }
  expect('(', "'('");
  parse_arguments(node);
  if (take('{')) {
    while (!take('}')) {
      if (rest_.empty()) {
        tree_.fail(node.place,
                   fmt::format("{} has no end: a '}}' is missing", in_quotes(node.name)));
      }
      parse_node(node.children, depth + 1);
    }
  } else {
    expect(';', "';' or '{'");
  }
  if (!background) siblings.push_back(std::move(node));
}

void Parser::parse_arguments(Node& node) {
  while (!take(')')) {
    if (!node.arguments.empty()) expect(',', "',' or ')'");
    skip_blanks();
    const std::string_view before = rest_;
    const Place place = place_;
    std::string_view name = take_name();
    if (name.empty() || !take('=')) {  // no name after all
      rest_ = before, place_ = place, name = {};
    }
    node.arguments.push_back({name, parse_value(1)});
  }
}

Literal Parser::parse_value(int depth) {
  if (depth > kDeepest) fail(fmt::format("more than {} lists inside one another", kDeepest));
  if (++value_count_ > kMostValues) fail(fmt::format("more than {} values", kMostValues));
  skip_blanks();
  Literal value{{}, place_};
  if (take('[')) {
    Literal::List list;
    while (!take(']')) {
      if (!list.empty()) expect(',', "',' or ']'");
      list.push_back(parse_value(depth + 1));
    }
    value.content = std::move(list);
  } else if (at('"')) {
    value.content = parse_text();
  } else if (!rest_.empty() && (is_digit(rest_.front()) || at('-') || at('+') || at('.'))) {
    value.content = parse_number();
  } else {
    const std::string_view word = take_name();
    if (word == "true" || word == "false") {
      value.content = word == "true";
    } else if (word != "undef") {
      place_ = value.place;
      if (word.empty()) fail_expecting("a value");
      fail(fmt::format("{} is no value: numbers are finite here", in_quotes(word)));
    }
  }
  return value;
}

double Parser::parse_number() {
  double number = 0;
  const std::string_view digits = rest_.substr(at('+') ? 1 : 0);
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const auto size = static_cast<std::size_t>(end - rest_.data());
  if (failure == std::errc::result_out_of_range) fail("this number is too large, or too near 0");
  if (failure != std::errc{} || !std::isfinite(number) ||
      (size < rest_.size() && (is_name(rest_[size]) || rest_[size] == '.'))) {
    std::size_t length = 1;
    while (length < rest_.size() && (is_name(rest_[length]) || rest_[length] == '.')) ++length;
    fail(fmt::format("{} is no finite number", in_quotes(rest_.substr(0, length))));
  }
  step(size);
  return number;
}

std::string Parser::parse_text() {
  const Place begin = place_;
  std::string text;
  for (step(); !at('"'); step()) {
    if (rest_.empty()) tree_.fail(begin, "this text does not end: close it with '\"'");
    if (at('\\') && rest_.size() > 1) step();
    text += rest_.front();
  }
  step();
  return text;
}

}  // namespace

const Literal* Node::find(std::string_view argument) const {
  for (const Argument& each : arguments) {
    if (each.name == argument) return &each.value;
  }
  return nullptr;
}

Tree parse(std::string_view text, std::string file) {
  Tree tree{std::move(file), {}};
  Parser(text, tree).parse();
  return tree;
}

}  // namespace isolux::openscad
