#include "isolux/scene/transform_reader.h"

#include <numbers>

namespace isolux {
namespace {

constexpr double kLargestFactor = 1e6;  ///< of a scale or matrix, and its inverse

Affine read_rotation(const Value& value) {
  const Fields fields(value, {"axis", "angle"});
  const Vec3 axis = fields.require("axis").direction();
  const double degrees = fields.require("angle").number();
  return Affine::rotate(axis, std::fmod(degrees, 360.0) * std::numbers::pi / 180);
}

Affine read_scale(const Value& value) {
  const Vec3 factors = value.is_list() ? value.vector() : Vec3{1, 1, 1} * value.number();
  for (int axis = 0; axis < 3; ++axis) {
    const double factor = std::abs(factors[axis]);
    if (!(factor >= 1 / kLargestFactor && factor <= kLargestFactor)) {
      value.fail("'scale' must not be 0, and between 1e-6 and 1e6 (or minus that)");
    }
  }
  return Affine::scale(factors);
}

/// Three rows of four: the linear part, and the translation (lengths) as the last column.
Affine read_matrix(const Value& value) {
  Affine map;
  const std::vector<Value> rows = value.items(3, 3);
  for (int i = 0; i < 3; ++i) {
    const std::vector<Value> row = rows[static_cast<std::size_t>(i)].items(4, 4);
    map.linear[static_cast<std::size_t>(i)] = {row[0].number(), row[1].number(), row[2].number()};
    map.translation[i] = row[3].length();
    for (int j = 0; j < 3; ++j) {
      if (std::abs(map.linear[static_cast<std::size_t>(i)][j]) > kLargestFactor) {
        row[static_cast<std::size_t>(j)].fail("'matrix' entries must be within 1e6");
      }
    }
  }
  if (!map.inverse()) value.fail("'matrix' is singular: it flattens the shape, so mend its rows");
  return map;
}

}  // namespace

Affine read_transform(const Value& steps) {
  Affine map;
  for (const Value& step : steps.items(1)) {
    const Fields fields(step, {"translate", "rotate", "scale", "matrix"});
    if (step.entries().size() != 1) {
      step.fail(
          "a step of 'transform' must be one of translate, rotate, scale or matrix: start "
          "each with its own '-'");
    }
    const Value value = step.entries().front().second;
    const std::string_view kind = value.label();
    const Affine next = kind == "translate" ? Affine::translate(value.point())
                        : kind == "rotate"  ? read_rotation(value)
                        : kind == "scale"   ? read_scale(value)
                                            : read_matrix(value);
    map = next * map;
    if (!map.inverse() || !is_finite(map.translation)) {
      step.fail("the steps of 'transform' together shrink or stretch the shape too much");
    }
  }
  return map;
}

}  // namespace isolux
