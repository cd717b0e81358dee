#include "isolux/geometry/expression.h"

#include <fmt/format.h>

#include <charconv>

#include "isolux/core/error.h"

namespace isolux {

/// Goes through the text by recursive descent; each function returns the step of its result.
class ExpressionParser {
 public:
  explicit ExpressionParser(Expression& expression)
      : text_(expression.text_), steps_(expression.steps_) {}

  void parse() {
    sum();
    if (at_ < text_.size()) fail(fmt::format("unexpected '{}'", shown()));
  }

 private:
  using Code = Expression::Code;
  static constexpr std::size_t kMostSteps = 500;
  static constexpr int kDeepest = 100;
  static constexpr int kLargestPower = 64;
  struct Function {
    std::string_view name;
    Code code;
  };
  static constexpr std::array<Function, 7> kFunctions = {{{"sqrt", Code::sqrt},
                                                          {"abs", Code::abs},
                                                          {"sin", Code::sin},
                                                          {"cos", Code::cos},
                                                          {"exp", Code::exp},
                                                          {"min", Code::min},
                                                          {"max", Code::max}}};

  [[noreturn]] void fail(const std::string& message) const { fail(at_, message); }
  [[noreturn]] static void fail(std::size_t at, const std::string& message) {
    throw InputError(fmt::format("function: {} at character {}", message, at + 1));
  }
  char shown() const { return text_[at_] >= ' ' && text_[at_] <= '~' ? text_[at_] : '?'; }

  void pass_blanks() {
    while (at_ < text_.size() &&
           std::string_view(" \t\r\n").find(text_[at_]) != std::string::npos) {
      ++at_;
    }
  }
  bool take(char c) {
    pass_blanks();
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void need(char c) {
    if (!take(c)) fail(fmt::format("expected '{}'", c));
  }
  static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  std::uint16_t add(Code code, std::uint16_t a = 0, std::uint16_t b = 0, double number = 0) {
    if (steps_.size() == kMostSteps) fail(fmt::format("more than {} operations", kMostSteps));
    steps_.push_back({code, a, b, number});
    return static_cast<std::uint16_t>(steps_.size() - 1);
  }

  std::uint16_t sum() {
    std::uint16_t result = product();
    for (;;) {
      if (take('+')) {
        result = add(Code::add, result, product());
      } else if (take('-')) {
        result = add(Code::subtract, result, product());
      } else {
        return result;
      }
    }
  }

  std::uint16_t product() {
    std::uint16_t result = signed_power();
    for (;;) {
      if (take('*')) {
        result = add(Code::multiply, result, signed_power());
      } else if (take('/')) {
        result = add(Code::divide, result, signed_power());
      } else {
        return result;
      }
    }
  }

  /// −x² is −(x²).
  std::uint16_t signed_power() {
    bool negative = false;
    for (;;) {
      if (take('-')) {
        negative = !negative;
      } else if (!take('+')) {
        break;
      }
    }
    std::uint16_t result = atom();
    if (take('^')) result = add(Code::power, result, exponent());
    pass_blanks();
    return negative ? add(Code::negate, result) : result;
  }

  std::uint16_t exponent() {
    pass_blanks();
    const std::size_t start = at_;
    int value = -1;
    const auto [end, fault] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (fault != std::errc{} || value < 0 || value > kLargestPower) {
      fail(start, fmt::format("expected a whole number from 0 to {} as exponent", kLargestPower));
    }
    at_ = static_cast<std::size_t>(end - text_.data());
    return static_cast<std::uint16_t>(value);
  }

  std::uint16_t atom() {
    pass_blanks();
    if (at_ == text_.size()) fail("the text ends too early");
    if (++depth_ > kDeepest) fail(fmt::format("more than {} levels", kDeepest));
    std::uint16_t result = 0;
    if (take('(')) {
      result = sum();
      need(')');
    } else if (is_letter(text_[at_])) {
      result = named();
    } else {
      result = number();
    }
    --depth_;
    return result;
  }

  std::uint16_t number() {
    double value = 0;
    const auto [end, fault] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (!(is_digit(text_[at_]) || text_[at_] == '.') || fault == std::errc::invalid_argument) {
      fail(fmt::format("unexpected '{}'", shown()));
    }
    if (fault != std::errc{}) fail("a number that is too large or too small");
    at_ = static_cast<std::size_t>(end - text_.data());
    return add(Code::number, 0, 0, value);
  }

  std::uint16_t named() {
    const std::size_t start = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view name = std::string_view(text_).substr(start, at_ - start);
    if (name == "pi") return add(Code::number, 0, 0, std::numbers::pi);
    if (name.size() == 1 && name[0] >= 'x' && name[0] <= 'z') {
      return add(Code::variable, static_cast<std::uint16_t>(name[0] - 'x'));
    }
    for (const auto& [known, code] : kFunctions) {
      if (name == known) return call(code);
    }
    fail(start, fmt::format("there is no '{}' (x, y, z, pi, sqrt, abs, sin, cos, exp, min, max)",
                            name.substr(0, 20)));
  }

  std::uint16_t call(Code code) {
    need('(');
    std::uint16_t result = sum();
    if (code == Code::min || code == Code::max) {
      need(',');
      do {
        result = add(code, result, sum());
      } while (take(','));
    } else {
      result = add(code, result);
    }
    need(')');
    return result;
  }

  const std::string& text_;
  std::vector<Expression::Step>& steps_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Expression::Expression(std::string text) : text_(std::move(text)) {
  ExpressionParser(*this).parse();
}

}  // namespace isolux
