#include "isolux/formats/radiance/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <numbers>

#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

constexpr int kDeepest = 100;  ///< of parentheses and signs in each other

struct Function {
  std::string_view name;
  std::size_t arguments;
  double (*of)(const double* x);
};

/// Operators first, under their sign; '~' is the sign before a number.
constexpr Function kFunctions[] = {
    {"+", 2, [](const double* x) { return x[0] + x[1]; }},
    {"-", 2, [](const double* x) { return x[0] - x[1]; }},
    {"*", 2, [](const double* x) { return x[0] * x[1]; }},
    {"/", 2, [](const double* x) { return x[0] / x[1]; }},
    {"^", 2, [](const double* x) { return std::pow(x[0], x[1]); }},
    {"~", 1, [](const double* x) { return -x[0]; }},
    {"if", 3, [](const double* x) { return x[0] > 0 ? x[1] : x[2]; }},
    {"min", 2, [](const double* x) { return std::min(x[0], x[1]); }},
    {"max", 2, [](const double* x) { return std::max(x[0], x[1]); }},
    {"floor", 1, [](const double* x) { return std::floor(x[0]); }},
    {"ceil", 1, [](const double* x) { return std::ceil(x[0]); }},
    {"sqrt", 1, [](const double* x) { return std::sqrt(x[0]); }},
    {"exp", 1, [](const double* x) { return std::exp(x[0]); }},
    {"log", 1, [](const double* x) { return std::log(x[0]); }},
    {"log10", 1, [](const double* x) { return std::log10(x[0]); }},
    {"sin", 1, [](const double* x) { return std::sin(x[0]); }},
    {"cos", 1, [](const double* x) { return std::cos(x[0]); }},
    {"tan", 1, [](const double* x) { return std::tan(x[0]); }},
    {"asin", 1, [](const double* x) { return std::asin(x[0]); }},
    {"acos", 1, [](const double* x) { return std::acos(x[0]); }},
    {"atan", 1, [](const double* x) { return std::atan(x[0]); }},
    {"atan2", 2, [](const double* x) { return std::atan2(x[0], x[1]); }},
    // Cubic curves at t = x[4]: from x[0] to x[1] with the slopes x[2] and x[3] there, and those
    // of four control values.
    {"hermite", 5,
     [](const double* x) {
       const double t = x[4], u = 1 - t;
       return x[0] * u * u * (1 + 2 * t) + x[1] * t * t * (1 + 2 * u) + x[2] * t * u * u -
              x[3] * t * t * u;
     }},
    {"bezier", 5,
     [](const double* x) {
       const double t = x[4], u = 1 - t;
       return x[0] * u * u * u + 3 * x[1] * t * u * u + 3 * x[2] * t * t * u + x[3] * t * t * t;
     }},
    {"bspline", 5,
     [](const double* x) {
       const double t = x[4], u = 1 - t;
       return (x[0] * u * u * u + x[1] * (4 - 3 * t * t * (1 + u)) +
               x[2] * (4 - 3 * u * u * (1 + t)) + x[3] * t * t * t) /
              6;
     }},
};

std::size_t function_named(std::string_view name) {
  const auto found = std::find_if(std::begin(kFunctions), std::end(kFunctions),
                                  [&](const Function& f) { return f.name == name; });
  return static_cast<std::size_t>(found - std::begin(kFunctions));
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

/// Turns a text into steps by recursive descent.
class Expression::Parser {
 public:
  Parser(Expression& to, std::string_view text, std::vector<std::string_view> variables)
      : to_(to), text_(text), variables_(std::move(variables)) {}

  void parse() {
    sum();
    if (next() != '\0') fail("this does not belong to an expression");
  }

 private:
  [[noreturn]] void fail(std::string_view what) {
    to_.statement_.fail(to_.word_, fmt::format("{}: {}", in_quotes(text_.substr(at_)), what));
  }
  /// The next character that is no blank; 0 at the end.
  char next() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  void expect(char c) {
    if (next() != c) fail(fmt::format("'{}' must stand here", c));
    ++at_;
  }
  void apply(std::string_view name) {
    to_.steps_.push_back({Step::Kind::function, 0, function_named(name)});
  }

  void sum();
  void product();
  void power();
  void signed_operand();
  void operand();
  void name();

  Expression& to_;
  std::string_view text_;
  std::vector<std::string_view> variables_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

void Expression::Parser::sum() {
  product();
  while (next() == '+' || next() == '-') {
    const std::string_view sign = text_.substr(at_++, 1);
    product();
    apply(sign);
  }
}

void Expression::Parser::product() {
  power();
  while (next() == '*' || next() == '/') {
    const std::string_view sign = text_.substr(at_++, 1);
    power();
    apply(sign);
  }
}

/// Of powers in a row the last comes first; a sign before the base belongs to it.
void Expression::Parser::power() {
  if (++depth_ > kDeepest) fail("parentheses, signs and powers nested too deep");
  signed_operand();
  if (next() == '^') {
    ++at_;
    power();
    apply("^");
  }
  --depth_;
}

void Expression::Parser::signed_operand() {
  const bool negative = next() == '-';
  if (negative || next() == '+') ++at_;
  operand();
  if (negative) apply("~");
}

void Expression::Parser::operand() {
  if (next() == '(') {
    ++at_;
    sum();
    expect(')');
  } else if (is_letter(next())) {
    name();
  } else {
    double number = 0;
    const auto [end, failure] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
    if (failure != std::errc{} || !(is_digit(next()) || next() == '.')) {
      fail("a number or a name must stand here");
    }
    at_ = static_cast<std::size_t>(end - text_.data());
    to_.steps_.push_back({Step::Kind::number, number});
  }
}

void Expression::Parser::name() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
  const std::string_view name = text_.substr(begin, at_ - begin);
  if (next() != '(') {
    const auto found = std::find(variables_.begin(), variables_.end(), name);
    if (found != variables_.end()) {
      to_.steps_.push_back(
          {Step::Kind::variable, 0, static_cast<std::size_t>(found - variables_.begin())});
    } else if (name == "PI") {
      to_.steps_.push_back({Step::Kind::number, std::numbers::pi});
    } else {
      throw Unsupported{fmt::format("the variable {}", in_quotes(name))};
    }
    return;
  }
  const std::size_t function = function_named(name);
  if (function == std::size(kFunctions)) {
    throw Unsupported{fmt::format("the function {}", in_quotes(name))};
  }
  for (std::size_t i = 0; i < kFunctions[function].arguments; ++i) {
    expect(i == 0 ? '(' : ',');
    sum();
  }
  expect(')');
  apply(name);
}

Expression::Expression(const Statement& s, std::size_t i, std::vector<std::string_view> variables)
    : statement_(s), word_(i) {
  Parser(*this, s.word(i), std::move(variables)).parse();
}

double Expression::operator()(const std::vector<double>& values) const {
  std::vector<double> stack;
  for (const Step& step : steps_) {
    if (step.kind == Step::Kind::number) {
      stack.push_back(step.number);
    } else if (step.kind == Step::Kind::variable) {
      stack.push_back(values[step.index]);
    } else {
      const Function& function = kFunctions[step.index];
      const std::size_t first = stack.size() - function.arguments;
      stack[first] = function.of(&stack[first]);
      stack.resize(first + 1);
    }
  }
  if (!std::isfinite(stack.back())) {
    statement_.fail(word_,
                    fmt::format("{} comes to no finite number", in_quotes(statement_.word(word_))));
  }
  return stack.back();
}

}  // namespace isolux::radiance
