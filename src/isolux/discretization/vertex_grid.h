#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "isolux/core/vec3.h"

namespace isolux {

/// A regular grid over the vertices (§3.2.2), of which only the voxels in use take memory.
class VertexGrid {
 public:
  /// `cell`: side of a voxel, m.
  VertexGrid(const Vec3& origin, double cell) : origin_(origin), cell_(cell) {}

  void insert(std::uint32_t id, const Vec3& position);

  /// Takes an id out that was inserted at this position.
  void erase(std::uint32_t id, const Vec3& position);

  /// Every id within `radius` of `center`, in no particular but a reproducible order; into `ids`
  /// (cleared first).
  void query(const Vec3& center, double radius, std::vector<std::uint32_t>& ids) const;

 private:
  struct Cell {
    std::int32_t x, y, z;
    bool operator==(const Cell&) const = default;
  };
  struct CellHash {
    std::size_t operator()(const Cell& c) const;
  };
  struct Entry {
    Vec3 position;
    std::uint32_t id;
  };
  Cell cell_of(const Vec3& p) const;

  Vec3 origin_;
  double cell_;
  std::unordered_map<Cell, std::vector<Entry>, CellHash> voxels_;
  // The box of all cells that were ever in use; empty at first.
  Cell lowest_{INT32_MAX, INT32_MAX, INT32_MAX}, highest_{INT32_MIN, INT32_MIN, INT32_MIN};
};

}  // namespace isolux
