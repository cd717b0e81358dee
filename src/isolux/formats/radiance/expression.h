#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "isolux/formats/statement.h"

namespace isolux::radiance {

/// A command asks for what is not read here.
struct Unsupported {
  std::string what;
};

/// An expression as the generators of Radiance take it, such as "hermite(0,1,2,3,t)": numbers,
/// variables, + - * / ^, parentheses and functions.
class Expression {
 public:
  /// Reads word i, in which the variables may occur. Throws InputError with the place where it is
  /// no expression, and Unsupported where it has names that are not known.
  Expression(const Statement& s, std::size_t i, std::vector<std::string_view> variables);

  /// Its value for those of the variables. Throws InputError with the place where that is no finite
  /// number.
  double operator()(const std::vector<double>& values) const;
  /// How many steps that takes.
  std::size_t effort() const { return steps_.size(); }

 private:
  class Parser;
  /// One step of a stack machine: pushes a number or a variable, or applies a function to what is
  /// on top.
  struct Step {
    enum class Kind { number, variable, function } kind;
    double number = 0;
    std::size_t index = 0;  ///< of the variable or function
  };

  Statement statement_;
  std::size_t word_;
  std::vector<Step> steps_;
};

}  // namespace isolux::radiance
