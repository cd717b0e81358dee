#include "isolux/scene/yaml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "isolux/scene/utf8.h"

namespace isolux {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// What YAML 1.1 and 1.2 take for a truth value, or for nothing.
bool is_reserved(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return static_cast<char>(is_letter(c) ? c | 0x20 : c); });
  for (const char* word : {"true", "false", "yes", "no", "on", "off", "y", "n", "null"}) {
    if (lower == word) return true;
  }
  return false;
}

/// Whether the text may stand without quotes anywhere.
bool is_plain(std::string_view text) {
  if (!is_letter(text.front()) || text.back() == ' ' || is_reserved(text)) return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') ||
           std::string_view(" _-+./()").find(c) != std::string_view::npos;
  });
}

}  // namespace

std::string to_yaml(double number) { return fmt::format("{}", number + 0.0); }

std::string to_yaml(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x + 0.0, v.y + 0.0, v.z + 0.0);
}

std::string to_yaml(const Rgb& color) {
  return color == gray(color.r) ? to_yaml(color.r) : to_yaml(Vec3{color.r, color.g, color.b});
}

std::string to_yaml(std::string_view text) {
  if (!text.empty() && is_plain(text)) return std::string(text);
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t size = utf8_length(text);
    const auto c = static_cast<unsigned char>(text[0]);
    if (size == 0) {
      quoted += '?';
    } else if (c < 0x20 || c == 0x7f) {
      fmt::format_to(std::back_inserter(quoted), "\\x{:02x}", c);
    } else {
      if (c == '"' || c == '\\') quoted += '\\';
      quoted += text.substr(0, size);
    }
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return quoted + '"';
}

}  // namespace isolux
