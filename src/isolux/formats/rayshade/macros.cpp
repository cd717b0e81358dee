#include "isolux/formats/rayshade/macros.h"

#include <fmt/format.h>

#include "isolux/scene/spelling.h"

namespace isolux::rayshade {
namespace {

constexpr std::size_t kMostParameters = 100;                 ///< of a macro
constexpr std::size_t kMostCalls = 1'000'000;                ///< of macros in a scene
constexpr std::size_t kMostWritten = std::size_t{64} << 20;  ///< bytes that they make together
constexpr int kDeepest = 100;                                ///< of calls in calls

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes a parenthesized list off the front of the text, which begins with '('; nothing where it
/// does not end.
std::optional<std::vector<std::string>> take_arguments(std::string_view& text) {
  std::vector<std::string> arguments(1);
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '(' && depth++ == 0) continue;
    if (c == ')' && --depth == 0) {
      text.remove_prefix(i + 1);
      for (std::string& argument : arguments) argument = trimmed(argument);
      return arguments;
    }
    if (c == ',' && depth == 1) {
      arguments.emplace_back();
    } else {
      arguments.back() += c;
    }
  }
  return std::nullopt;
}

/// The first part of a text: an identifier, a number, or one other character.
std::string_view leading_part(std::string_view text) {
  if (const auto identifier = leading_identifier(text); !identifier.empty()) return identifier;
  if (const auto number = leading_number(text); !number.empty()) return number;
  return text.substr(0, 1);
}

}  // namespace

std::string_view leading_identifier(std::string_view text) {
  if (text.empty() || !starts_identifier(text[0])) return {};
  std::size_t size = 1;
  while (size < text.size() && (starts_identifier(text[size]) || is_digit(text[size]))) ++size;
  return text.substr(0, size);
}

std::string_view leading_number(std::string_view text) {
  const bool starts = !text.empty() && (is_digit(text[0]) ||
                                        (text[0] == '.' && text.size() > 1 && is_digit(text[1])));
  if (!starts) return {};
  std::size_t size = 1;
  while (size < text.size() &&
         (starts_identifier(text[size]) || is_digit(text[size]) || text[size] == '.')) {
    ++size;
  }
  return text.substr(0, size);
}

void Macros::define(std::string_view text, const Place& place) {
  const std::string_view name = leading_identifier(text);
  if (name.empty()) fail(place, "'#define' needs a name of letters, digits and _");
  text.remove_prefix(name.size());
  Macro macro;
  if (!text.empty() && text[0] == '(') {
    macro.parameters = take_arguments(text);
    if (!macro.parameters) {
      fail(place, fmt::format("the parameters of {} lack their ')'", in_quotes(name)));
    }
    if (macro.parameters->size() == 1 && macro.parameters->front().empty()) {
      macro.parameters->clear();
    }
    if (macro.parameters->size() > kMostParameters) {
      fail(place,
           fmt::format("macro {} has more than {} parameters", in_quotes(name), kMostParameters));
    }
    for (const std::string& parameter : *macro.parameters) {
      if (parameter.empty() || leading_identifier(parameter) != parameter) {
        fail(place, fmt::format("{} is no name for a parameter of {}", in_quotes(parameter),
                                in_quotes(name)));
      }
    }
  }
  macro.body = trimmed(text);
  macros_.insert_or_assign(std::string(name), std::move(macro));
}

bool Macros::takes_arguments(std::string_view name) const {
  const auto found = macros_.find(name);
  return found != macros_.end() && found->second.parameters.has_value();
}

void Macros::append(std::string& text, std::string_view more, const Place& place) {
  written_ += more.size();
  if (written_ > kMostWritten) fail(place, "the macros make more than 64 MiB of text");
  text += more;
}

std::string Macros::expand(std::string_view text, const Place& place) {
  if (depth_ >= kDeepest) {
    fail(place, fmt::format("macros are nested more than {} deep here", kDeepest));
  }
  ++depth_;
  std::string out;
  while (!text.empty()) {
    const std::string_view part = leading_part(text);
    text.remove_prefix(part.size());
    const auto found = macros_.find(part);
    if (found == macros_.end() || found->second.hidden) {
      append(out, part, place);
      continue;
    }
    Macro& macro = found->second;
    std::vector<std::string> arguments;
    if (macro.parameters) {
      std::string_view rest = text;
      while (!rest.empty() && (rest[0] == ' ' || rest[0] == '\t' || rest[0] == '\n')) {
        rest.remove_prefix(1);
      }
      if (rest.empty() || rest[0] != '(') {
        append(out, part, place);
        continue;
      }
      auto taken = take_arguments(rest);
      if (!taken) fail(place, fmt::format("the call of macro {} lacks its ')'", in_quotes(part)));
      text = rest;
      if (macro.parameters->empty() && taken->size() == 1 && taken->front().empty()) taken->clear();
      if (taken->size() != macro.parameters->size()) {
        fail(place, fmt::format("macro {} takes {} arguments, not {}", in_quotes(part),
                                macro.parameters->size(), taken->size()));
      }
      for (const std::string& argument : *taken) arguments.push_back(expand(argument, place));
    }
    append(out, call(macro, arguments, place), place);
  }
  --depth_;
  return out;
}

std::string Macros::call(Macro& macro, const std::vector<std::string>& arguments,
                         const Place& place) {
  if (++calls_ > kMostCalls) fail(place, "the scene expands more than a million macros");
  written_ += macro.body.size();  // even where nothing comes of it
  std::string body;
  for (std::string_view rest = macro.body; !rest.empty();) {
    std::string_view part = leading_part(rest);
    rest.remove_prefix(part.size());
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if ((*macro.parameters)[i] == part) {
        part = arguments[i];
        break;
      }
    }
    append(body, part, place);
  }
  macro.hidden = true;
  std::string out = expand(body, place);
  macro.hidden = false;
  return out;
}

}  // namespace isolux::rayshade
