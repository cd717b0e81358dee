#include "arguments.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <numbers>

namespace isolux {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

template <typename Number>
Number parse(const std::string& option, const std::string& given, Number least, Number most) {
  Number number{};
  const char* const end = given.data() + given.size();
  const auto [stop, failure] = std::from_chars(given.data(), end, number);
  // Written so that NaN fails.
  const bool good = failure == std::errc() && stop == end && number >= least && number <= most;
  if (!good) {
    throw CLI::ValidationError(
        option, fmt::format("'{}' must be a number from {} to {}", given, least, most));
  }
  return number;
}

}  // namespace

template <typename Number>
CLI::Option* add_number(CLI::App& command, const std::string& name, const std::string& text,
                        Number& value, Number least, Number most, const std::string& help) {
  return command
      .add_option_function<std::string>(
          name,
          [&value, name, least, most](const std::string& given) {
            value = parse(name, given, least, most);
          },
          fmt::format("{} [{}]", help, value))
      ->option_text(text);
}

template CLI::Option* add_number(CLI::App&, const std::string&, const std::string&, int&, int, int,
                                 const std::string&);
template CLI::Option* add_number(CLI::App&, const std::string&, const std::string&, std::uint64_t&,
                                 std::uint64_t, std::uint64_t, const std::string&);
template CLI::Option* add_number(CLI::App&, const std::string&, const std::string&, double&, double,
                                 double, const std::string&);

CLI::Option* add_angle(CLI::App& command, const std::string& name, double& radians, double least,
                       double most, const std::string& help) {
  return command
      .add_option_function<std::string>(
          name,
          [&radians, name, least, most](const std::string& given) {
            radians = parse(name, given, least, most) * kDegree;
          },
          fmt::format("{} [{:.4g}]", help, radians / kDegree))
      ->option_text("DEG");
}

CLI::Option* add_percentage(CLI::App& command, const std::string& name, double& share, double least,
                            double most, const std::string& help) {
  return command
      .add_option_function<std::string>(
          name,
          [&share, name, least, most](const std::string& given) {
            const std::string number =
                given.ends_with('%') ? given.substr(0, given.size() - 1) : given;
            share = parse(name, number, least, most) / 100;
          },
          fmt::format("{} [{:.4g}]", help, 100 * share))
      ->option_text("%");
}

}  // namespace isolux
