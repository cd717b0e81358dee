#pragma once

#include <string_view>

namespace isolux {

/// Whether a JSON text nests at most `max_depth` deep and has about `max_values` values at most, by
/// its brackets and commas alone. To be asked ahead of nlohmann's parser: its callback could tell
/// too, but makes it search each list anew for every object within.
bool within_json_limits(std::string_view text, int max_depth, int max_values);

}  // namespace isolux
