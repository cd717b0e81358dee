#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace isolux {

/// A voxel of one of up to sixteen grids, packed: 20 bits for each coordinate, which wrap around
/// (far voxels then share a list, which costs time only), and the grid's number.
using VoxelKey = std::uint64_t;

inline VoxelKey voxel_key(int grid, std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t kMask = (1u << 20) - 1;
  return (static_cast<std::uint64_t>(grid) << 60) |
         ((static_cast<std::uint64_t>(x) & kMask) << 40) |
         ((static_cast<std::uint64_t>(y) & kMask) << 20) | (static_cast<std::uint64_t>(z) & kMask);
}

/// What lies in each voxel, by number: a hash table that is made once and read very often.
class VoxelTable {
 public:
  using Entry = std::pair<VoxelKey, std::uint32_t>;  // a voxel and what lies in it

  explicit VoxelTable(std::span<const Entry> entries = {});

  /// All that lies in the voxel, in the order of the entries.
  std::span<const std::uint32_t> find(VoxelKey key) const {
    const Voxel& voxel = table_[slot_of(key)];
    return std::span(listed_).subspan(voxel.first, voxel.count);
  }

  /// Fetches into the cache what find() reads first.
  void prefetch(VoxelKey key) const { __builtin_prefetch(&table_[first_slot(key)]); }

 private:
  /// A slot of the hash table: a voxel and its part of `listed_`; free where count is 0.
  struct Voxel {
    VoxelKey key = 0;
    std::uint32_t first = 0, count = 0;
  };

  std::size_t first_slot(VoxelKey key) const {
    key *= 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(key ^ (key >> 29)) & (table_.size() - 1);
  }

  /// Where the voxel stands in the table, or would.
  std::size_t slot_of(VoxelKey key) const {
    std::size_t slot = first_slot(key);
    while (table_[slot].count > 0 && table_[slot].key != key) {
      slot = (slot + 1) & (table_.size() - 1);
    }
    return slot;
  }

  void grow();

  std::vector<Voxel> table_;           // a power of two of slots
  std::vector<std::uint32_t> listed_;  // what lies in the voxels, one after the other
};

}  // namespace isolux
