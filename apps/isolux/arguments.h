#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

namespace isolux {

/// Adds an option that takes a number from `least` to `most`, read strictly: no other base, no
/// unit, no NaN. `value` holds the default, which the help shows; `text` is what the help calls it.
template <typename Number>
CLI::Option* add_number(CLI::App& command, const std::string& name, const std::string& text,
                        Number& value, Number least, Number most, const std::string& help);

/// The same for an angle: from `least` to `most` degrees on the command line, kept in radians.
CLI::Option* add_angle(CLI::App& command, const std::string& name, double& radians, double least,
                       double most, const std::string& help);

/// The same for a share, given in per cent: `2` and `2%` are both 0.02.
CLI::Option* add_percentage(CLI::App& command, const std::string& name, double& share, double least,
                            double most, const std::string& help);

/// Adds an option that takes one of the named choices; `value` holds the default.
template <typename Choice>
CLI::Option* add_choice(CLI::App& command, const std::string& name, Choice& value,
                        const std::vector<std::pair<std::string, Choice>>& choices,
                        const std::string& help) {
  std::string names, standard;
  for (const auto& [label, choice] : choices) {
    names += (names.empty() ? "" : " or ") + label;
    if (choice == value) standard = label;
  }
  const auto set = [&value, name, names, choices](const std::string& given) {
    for (const auto& [label, choice] : choices) {
      if (label == given) {
        value = choice;
        return;
      }
    }
    throw CLI::ValidationError(name, "'" + given + "' must be " + names);
  };
  return command
      .add_option_function<std::string>(name, set,
                                        standard.empty() ? help : help + " [" + standard + "]")
      ->option_text("NAME");
}

}  // namespace isolux
