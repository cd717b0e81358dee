#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"

namespace isolux {

// Values as YAML writes them within a line. Numbers are the shortest that read back as the same
// double; −0 becomes 0.

std::string to_yaml(double number);
std::string to_yaml(const Vec3& v);
/// One number where the channels are equal, else a list of three.
std::string to_yaml(const Rgb& color);

/// A text that is not empty: as it is where no reader of YAML could take it for something else,
/// otherwise in double quotes. Bytes that are no UTF-8 become '?'.
std::string to_yaml(std::string_view text);

/// "[a, b, c]" of anything that has a to_yaml().
template <typename Range>
std::string to_yaml_list(const Range& items) {
  std::string list = "[";
  for (const auto& item : items) {
    if (list.size() > 1) list += ", ";
    list += to_yaml(item);
  }
  return list + "]";
}

}  // namespace isolux
