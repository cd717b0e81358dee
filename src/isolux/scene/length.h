#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace isolux {

/// Names of the units of length that a scene may use.
const std::vector<std::string_view>& length_units();

/// How many metres the unit of that name has; nothing where there is no such unit.
std::optional<double> metres_per(std::string_view unit);

/// A decimal number as YAML and JSON write it, the whole of `text`: infinite or NaN where it says
/// so (".inf", ".nan") or is too large; nothing where it is no number.
std::optional<double> parse_number(std::string_view text);

/// A text such as "30 cm" or "30cm", taken apart.
struct NumberWithUnit {
  double number = 0;
  std::string_view unit;  ///< what follows the number, empty where nothing does
};
std::optional<NumberWithUnit> split_unit(std::string_view text);

}  // namespace isolux
