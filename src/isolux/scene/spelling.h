#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isolux {

/// The candidate nearest to `word` by optimal string alignment distance (insert, delete, replace,
/// swap neighbours; case ignored); nothing where none is near enough to be what was meant.
std::optional<std::string_view> nearest_name(std::string_view word,
                                             const std::vector<std::string_view>& candidates);

/// How to mend an unknown word: "did you mean 'radius'?", or which words there are.
std::string suggestion(std::string_view word, const std::vector<std::string_view>& candidates);

/// The text in quotes, fit for a one-line message: shortened, without control characters.
std::string in_quotes(std::string_view text);

/// "'a', 'b' and 'c'"; a long list is cut short.
std::string enumerated(const std::vector<std::string_view>& words);

}  // namespace isolux
