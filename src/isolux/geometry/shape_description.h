#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "isolux/core/affine.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// A shape as the numbers it was made from, under the keys of the native scene format
/// (docs/scene-format.md), in metres: what writers of scenes know of it. Texts live as long as the
/// shape.
struct ShapeDescription {
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  using Outlines = std::vector<std::vector<Vec3>>;
  using Rows = std::vector<std::vector<double>>;
  struct Field;
  using Record = std::vector<Field>;  ///< a map within a list
  using Value = std::variant<bool, double, Vec3, std::vector<double>, std::vector<Vec3>, Triangles,
                             Outlines, Rows, std::vector<Record>, std::string_view>;
  struct Field {
    std::string_view key;
    Value value;
  };

  std::string_view kind;  ///< "sphere", "union", ...
  std::vector<Field> fields;
  /// What a union, difference, complement, reversed ... is made of.
  std::vector<std::shared_ptr<const Shape>> operands;
  std::optional<Affine> transform;  ///< applied to all of the above

  /// The value under that key; null where there is none or it is of another type.
  template <typename T>
  const T* find(std::string_view key) const {
    for (const Field& field : fields) {
      if (field.key == key) return std::get_if<T>(&field.value);
    }
    return nullptr;
  }
  bool flag(std::string_view key) const {
    const bool* const value = find<bool>(key);
    return value && *value;
  }
};

}  // namespace isolux
