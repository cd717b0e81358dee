#include "isolux/scene/length.h"

#include <charconv>
#include <limits>
#include <string>

namespace isolux {
namespace {

struct Unit {
  std::string_view name;
  double metres;
};

// Inch and foot: the international yard and pound agreement of 1959.
constexpr Unit kUnits[] = {{"m", 1},     {"cm", 0.01},   {"mm", 0.001},
                           {"km", 1000}, {"in", 0.0254}, {"ft", 0.3048}};

bool starts_number(std::string_view text) {
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  if (text.size() <= sign) return false;
  const char c = text[sign];
  return (c >= '0' && c <= '9') || (c == '.' && text.size() > sign + 1);
}

std::string_view trimmed_front(std::string_view text) {
  const std::size_t start = text.find_first_not_of(" \t");
  return start == text.npos ? std::string_view{} : text.substr(start);
}

}  // namespace

const std::vector<std::string_view>& length_units() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Unit& unit : kUnits) list.push_back(unit.name);
    return list;
  }();
  return names;
}

std::optional<double> metres_per(std::string_view unit) {
  for (const Unit& known : kUnits) {
    if (known.name == unit) return known.metres;
  }
  return std::nullopt;
}

std::optional<NumberWithUnit> split_unit(std::string_view text) {
  if (!starts_number(text)) return std::nullopt;
  if (text[0] == '+') text.remove_prefix(1);
  const std::string_view digits = text[0] == '-' ? text.substr(1) : text;
  for (const char* special : {".inf", ".Inf", ".INF", ".nan", ".NaN", ".NAN"}) {
    if (digits != special) continue;
    const bool nan = special[1] == 'n' || special[1] == 'N';
    return NumberWithUnit{
        nan ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity(),
        {}};
  }
  NumberWithUnit parsed;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), parsed.number);
  if (status == std::errc::invalid_argument) return std::nullopt;
  if (status == std::errc::result_out_of_range) {
    parsed.number = std::numeric_limits<double>::infinity();
  }
  parsed.unit = trimmed_front(text.substr(static_cast<std::size_t>(end - text.data())));
  return parsed;
}

std::optional<double> parse_number(std::string_view text) {
  const std::optional<NumberWithUnit> parsed = split_unit(text);
  if (!parsed || !parsed->unit.empty()) return std::nullopt;
  return parsed->number;
}

}  // namespace isolux
