#include "isolux/formats/statement.h"

#include <fmt/format.h>

#include <cmath>

#include "isolux/scene/length.h"
#include "isolux/scene/spelling.h"

namespace isolux {

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

}  // namespace isolux
