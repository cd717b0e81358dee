#pragma once

#include <cmath>
#include <map>
#include <vector>

#include "isolux/discretization/vertex_grid.h"

namespace isolux {

/// Points that each have a size, in one VertexGrid for each power of two of the size, so that
/// neither small nor large ones crowd the voxels.
class GradedGrid {
 public:
  explicit GradedGrid(const Vec3& origin) : origin_(origin) {}

  void insert(std::uint32_t id, const Vec3& position, double size) {
    const int level = static_cast<int>(std::ceil(std::log2(size)));
    const auto found =
        levels_.try_emplace(level, Level{{origin_, std::ldexp(4.0, level)}, {}}).first;
    found->second.grid.insert(id, position);
    found->second.bounds.include(position);
  }

  /// The ids within `radius` and within `sizes` times their own size of `center`, and some up to
  /// twice as many sizes away; put behind `ids`.
  void query(const Vec3& center, double radius, double sizes,
             std::vector<std::uint32_t>& ids) const {
    thread_local std::vector<std::uint32_t> found;
    for (const auto& [level, points] : levels_) {
      const double reach = std::min(radius, sizes * std::ldexp(1.0, level));
      const Vec3 around = Vec3{1, 1, 1} * reach, lower = center - around, upper = center + around;
      const Bounds& b = points.bounds;
      if (lower.x > b.upper.x || lower.y > b.upper.y || lower.z > b.upper.z ||
          upper.x < b.lower.x || upper.y < b.lower.y || upper.z < b.lower.z) {
        continue;
      }
      points.grid.query(center, reach, found);
      ids.insert(ids.end(), found.begin(), found.end());
    }
  }

  void clear() { levels_.clear(); }

 private:
  struct Level {
    VertexGrid grid;
    Bounds bounds;  // of its points
  };
  Vec3 origin_;
  std::map<int, Level> levels_;
};

}  // namespace isolux
