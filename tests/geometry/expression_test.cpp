#include "isolux/geometry/expression.h"

#include <gtest/gtest.h>

#include "isolux/core/error.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {

Dual<double> value_at(const Expression& f, double x, double y, double z, double along_x = 0) {
  return f(std::array<Dual<double>, 3>{{{x, along_x}, {y, 0}, {z, 0}}});
}

TEST(ExpressionTest, Precedence) {
  const std::pair<const char*, double> cases[] = {
      {"1 + 2 * 3", 7},
      {"-x^2", -9},
      {"(-x)^2", 9},
      {"2*x/y/z", 0.25},
      {"1 - 2 - 3", -4},
      {"--2 - -1", 3},
      {"x^0 + .5e1", 6},
      {"min(x, y, z) + max(x, y, z)", 9},
      {"sqrt(y^2) + abs(1 - z)", 9},
      {"sqrt(-1)", 0},
      {"cos(pi) + sin(0) + exp(0)", 0},
      {" ( x ) ", 3},
  };
  for (const auto& [text, expected] : cases) {
    EXPECT_DOUBLE_EQ(value_at(Expression(text), 3, 6, 4).value, expected) << text;
  }
}

TEST(ExpressionTest, ErrorsNameTheCharacter) {
  const std::string deep(200, '('), sum(2000, '+');
  std::string long_sum = "x";
  for (int i = 0; i < 300; ++i) long_sum += "+x";
  const std::pair<std::string, std::string> cases[] = {
      {"", "the text ends too early at character 1"},
      {"x +", "the text ends too early at character 4"},
      {"x y", "unexpected 'y' at character 3"},
      {"x + * y", "unexpected '*' at character 5"},
      {"(x", "expected ')' at character 3"},
      {"sin x", "expected '(' at character 5"},
      {"min(x)", "expected ',' at character 6"},
      {"x + log(y)",
       "there is no 'log' (x, y, z, pi, sqrt, abs, sin, cos, exp, min, max) at "
       "character 5"},
      {"x^y", "expected a whole number from 0 to 64 as exponent at character 3"},
      {"x^-1", "expected a whole number from 0 to 64 as exponent at character 3"},
      {"x^65", "expected a whole number from 0 to 64 as exponent at character 3"},
      {"x^2^2", "unexpected '^' at character 4"},
      {"1e999", "a number that is too large or too small at character 1"},
      {"inf", "there is no 'inf' (x, y, z, pi, sqrt, abs, sin, cos, exp, min, max) at character 1"},
      {"x\x01", "unexpected '?' at character 2"},
      {deep, "more than 100 levels at character 101"},
      {long_sum, "more than 500 operations at character 502"},
      {sum, "the text ends too early at character 2001"},
  };
  for (const auto& [text, expected] : cases) {
    try {
      Expression expression(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()), "function: " + expected);
    }
  }
}

const char* const kFunctions[] = {"x*y - z/(1 + x^2)",        "sin(3*x)*cos(y) + exp(-z^2)",
                                  "sqrt(x^2 + y^2) - abs(z)", "min(x, y*z) + max(x^3, -y)",
                                  "1/x + y^5 - (z - x)^4",    "sqrt(x - 1) + cos(20*x + y)"};

TEST(ExpressionTest, SlopesAreDifferences) {
  constexpr double h = 1e-6;
  Random random(3);
  for (const char* const text : kFunctions) {
    const Expression f(text);
    for (int i = 0; i < 200; ++i) {
      const double x = 1.1 + random.uniform(), y = 2 * random.uniform() - 1;
      const double z = 0.01 + random.uniform();
      const double difference =
          (value_at(f, x + h, y, z).value - value_at(f, x - h, y, z).value) / (2 * h);
      EXPECT_NEAR(value_at(f, x, y, z, 1).slope, difference, 1e-3 * (1 + std::abs(difference)))
          << text;
    }
  }
}

// Whatever is taken from intervals lies in the interval of the values, and of the slopes.
TEST(ExpressionTest, IntervalsHoldAllValues) {
  Random random(5);
  const auto within = [&](const Enclosure& i) { return i.lo + (i.hi - i.lo) * random.uniform(); };
  for (const char* const text : kFunctions) {
    const Expression f(text);
    for (int i = 0; i < 500; ++i) {
      const double size = std::pow(10, -6 * random.uniform());
      std::array<Dual<Enclosure>, 3> box;
      for (auto& side : box) {
        side.value.lo = 4 * random.uniform() - 2;
        side.value.hi = side.value.lo + size * random.uniform();
      }
      box[0].slope = 1;
      const Dual<Enclosure> range = f(box);
      EXPECT_LE(range.value.lo, range.value.hi);
      for (int k = 0; k < 20; ++k) {
        const double x = within(box[0].value), y = within(box[1].value), z = within(box[2].value);
        const Dual<double> f_here = value_at(f, x, y, z, 1);
        EXPECT_TRUE(range.value.holds(f_here.value)) << text;
        EXPECT_TRUE(range.slope.holds(f_here.slope)) << text;
      }
    }
  }
}

}  // namespace
}  // namespace isolux
