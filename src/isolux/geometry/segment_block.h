#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "isolux/geometry/ray.h"

namespace isolux {

/// A few segments, each from a point along a way, coordinate by coordinate, so that a shape is held
/// against all of them at once.
struct SegmentBlock {
  static constexpr std::size_t kLanes = 16;
  using Lanes = std::array<double, kLanes>;
  /// 1 or 0 for each segment, as wide as a coordinate.
  using Mask = std::array<std::int64_t, kLanes>;

  alignas(64) Lanes from_x, from_y, from_z;  ///< where they start, m
  alignas(64) Lanes way_x, way_y, way_z;     ///< from there to their ends, m

  void set(std::size_t lane, const Ray& ray) {
    from_x[lane] = ray.origin.x, from_y[lane] = ray.origin.y, from_z[lane] = ray.origin.z;
    way_x[lane] = ray.direction.x, way_y[lane] = ray.direction.y, way_z[lane] = ray.direction.z;
  }
  Ray ray(std::size_t lane) const {
    return {{from_x[lane], from_y[lane], from_z[lane]}, {way_x[lane], way_y[lane], way_z[lane]}};
  }
};

}  // namespace isolux
