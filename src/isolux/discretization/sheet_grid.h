#pragma once

#include <algorithm>
#include <vector>

#include "isolux/discretization/graded_grid.h"

namespace isolux {

/// Points on the scene's surfaces, one GradedGrid for each object: what lies close by in space, but
/// on another surface, is not found. Objects whose surfaces run on into one another *adjoin*.
class SheetGrid {
 public:
  SheetGrid(const Vec3& origin, std::size_t objects)
      : grids_(objects, GradedGrid(origin)), adjoining_(objects) {
    for (std::uint32_t i = 0; i < objects; ++i) adjoining_[i].push_back(i);
  }

  /// From now on, a query on one of two objects finds points of the other too.
  void adjoin(std::uint32_t a, std::uint32_t b) {
    if (a == b || std::ranges::find(adjoining_[a], b) != adjoining_[a].end()) return;
    adjoining_[a].push_back(b), adjoining_[b].push_back(a);
  }

  void insert(std::uint32_t id, std::uint32_t object, const Vec3& position, double size) {
    grids_[object].insert(id, position, size);
  }

  /// As GradedGrid::query(), on an object and those that adjoin it.
  void query(std::uint32_t object, const Vec3& center, double radius, double sizes,
             std::vector<std::uint32_t>& ids) const {
    ids.clear();
    for (const std::uint32_t other : adjoining_[object]) {
      grids_[other].query(center, radius, sizes, ids);
    }
  }

  void clear() {
    for (GradedGrid& grid : grids_) grid.clear();
  }

 private:
  std::vector<GradedGrid> grids_;
  std::vector<std::vector<std::uint32_t>> adjoining_;  // each object first
};

}  // namespace isolux
