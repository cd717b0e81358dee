#include "isolux/discretization/voxel_table.h"

#include <bit>

namespace isolux {

VoxelTable::VoxelTable(std::span<const Entry> entries)
    // There are no more voxels than entries; as a rule a quarter of them.
    : table_(std::bit_ceil(entries.size() / 2 + 2)), listed_(entries.size()) {
  std::size_t voxels = 0;
  for (const auto& [key, number] : entries) {
    if (4 * voxels >= 3 * table_.size()) grow();
    Voxel& voxel = table_[slot_of(key)];
    voxels += voxel.count++ == 0;
    voxel.key = key;
  }
  std::uint32_t end = 0;
  for (Voxel& voxel : table_) voxel.first = end, end += voxel.count;
  for (const auto& [key, number] : entries) listed_[table_[slot_of(key)].first++] = number;
  for (Voxel& voxel : table_) voxel.first -= voxel.count;
}

void VoxelTable::grow() {
  const std::vector<Voxel> voxels = std::exchange(table_, std::vector<Voxel>(2 * table_.size()));
  for (const Voxel& voxel : voxels) {
    if (voxel.count > 0) table_[slot_of(voxel.key)] = voxel;
  }
}

}  // namespace isolux
