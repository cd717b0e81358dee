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
    levels_.try_emplace(level, origin_, std::ldexp(4.0, level)).first->second.insert(id, position);
  }

  /// A superset of the ids within `radius` and within `sizes` times their own size of `center`;
  /// into `ids` (cleared first).
  void query(const Vec3& center, double radius, double sizes,
             std::vector<std::uint32_t>& ids) const {
    ids.clear();
    thread_local std::vector<std::uint32_t> found;
    for (const auto& [level, grid] : levels_) {
      grid.query(center, std::min(radius, sizes * std::ldexp(1.0, level)), found);
      ids.insert(ids.end(), found.begin(), found.end());
    }
  }

 private:
  Vec3 origin_;
  std::map<int, VertexGrid> levels_;
};

}  // namespace isolux
