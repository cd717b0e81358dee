#pragma once

#include <yaml-cpp/eventhandler.h>

#include <string_view>

namespace isolux {

/// Parses the plain part of YAML, much faster than a parser of all of it: lists and
/// maps by indentation or within one line, words and numbers of unsuspicious characters, quotes
/// without escapes, comments. Returns false where there is anything else, faults included, with
/// events given up to there that mean nothing; true where the events are those that yaml-cpp would
/// give.
bool parse_plain(std::string_view text, YAML::EventHandler& handler);

}  // namespace isolux
