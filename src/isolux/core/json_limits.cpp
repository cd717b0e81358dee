#include "isolux/core/json_limits.h"

namespace isolux {

bool within_json_limits(std::string_view text, int max_depth, int max_values) {
  int depth = 0, values = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      quoted = !quoted;
    } else if (quoted) {
      if (c == '\\') ++i;
    } else if (c == '[' || c == '{') {
      ++depth, ++values;
    } else if (c == ']' || c == '}') {
      --depth;
    } else if (c == ',') {
      ++values;
    }
    if (depth > max_depth || values > max_values) return false;
  }
  return true;
}

}  // namespace isolux
