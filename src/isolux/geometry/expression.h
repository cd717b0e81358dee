#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/geometry/dual.h"

namespace isolux {

/// A function of x, y and z as a text: numbers, pi, + - * /, ^ with a whole number from 0 to 64,
/// parentheses, sqrt (0 of what is negative), abs, sin, cos, exp, min and max.
class Expression {
 public:
  /// Throws InputError that names the character at which the text goes wrong; texts have at most
  /// 500 operations, nested at most 100 deep.
  explicit Expression(std::string text);

  const std::string& text() const { return text_; }
  /// The function and its derivative, the variables having theirs. `Number` is double or Enclosure.
  template <typename Number>
  Dual<Number> operator()(const std::array<Dual<Number>, 3>& variables) const;

 private:
  friend class ExpressionParser;
  enum class Code {
    number,
    variable,
    negate,
    add,
    subtract,
    multiply,
    divide,
    power,
    sqrt,
    abs,
    sin,
    cos,
    exp,
    min,
    max
  };
  /// One step: what it takes are the results of the steps `a` and `b`.
  struct Step {
    Code code;
    std::uint16_t a = 0, b = 0;  ///< of a variable, which; of a power, b is the exponent
    double number = 0;
  };

  std::string text_;
  std::vector<Step> steps_;  ///< each after those that it takes; the last gives the function
};

template <typename Number>
Dual<Number> Expression::operator()(const std::array<Dual<Number>, 3>& variables) const {
  thread_local std::vector<Dual<Number>> results;
  results.resize(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const auto a = [&]() -> const Dual<Number>& { return results[step.a]; };
    const auto b = [&]() -> const Dual<Number>& { return results[step.b]; };
    Dual<Number>& result = results[i];
    switch (step.code) {
      case Code::number:
        result = {Number(step.number), Number(0)};
        break;
      case Code::variable:
        result = variables[step.a];
        break;
      case Code::negate:
        result = -a();
        break;
      case Code::add:
        result = a() + b();
        break;
      case Code::subtract:
        result = a() - b();
        break;
      case Code::multiply:
        result = step.a == step.b ? isolux::power(a(), 2) : a() * b();
        break;
      case Code::divide:
        result = a() / b();
        break;
      case Code::power:
        result = isolux::power(a(), step.b);
        break;
      case Code::sqrt:
        result = isolux::sqrt(a());
        break;
      case Code::abs:
        result = isolux::abs(a());
        break;
      case Code::sin:
        result = isolux::sin(a());
        break;
      case Code::cos:
        result = isolux::cos(a());
        break;
      case Code::exp:
        result = isolux::exp(a());
        break;
      case Code::min:
        result = isolux::min(a(), b());
        break;
      case Code::max:
        result = isolux::max(a(), b());
        break;
    }
  }
  return results.back();
}

}  // namespace isolux
