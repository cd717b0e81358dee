#include "isolux/discretization/vertex_grid.h"

#include <algorithm>
#include <cmath>

namespace isolux {

VertexGrid::Cell VertexGrid::cell_of(const Vec3& p) const {
  const Vec3 q = (p - origin_) / cell_;
  return {static_cast<std::int32_t>(std::floor(q.x)), static_cast<std::int32_t>(std::floor(q.y)),
          static_cast<std::int32_t>(std::floor(q.z))};
}

std::size_t VertexGrid::CellHash::operator()(const Cell& c) const {
  // Three large primes, after Teschner et al. 2003, then folded so that low bits depend on all.
  std::uint64_t h = static_cast<std::uint32_t>(c.x) * 73856093ull ^
                    static_cast<std::uint32_t>(c.y) * 19349663ull ^
                    static_cast<std::uint32_t>(c.z) * 83492791ull;
  h *= 0x9e3779b97f4a7c15u;
  return static_cast<std::size_t>(h ^ (h >> 32));
}

void VertexGrid::insert(std::uint32_t id, const Vec3& position) {
  const Cell cell = cell_of(position);
  voxels_[cell].push_back({position, id});
  lowest_ = {std::min(lowest_.x, cell.x), std::min(lowest_.y, cell.y), std::min(lowest_.z, cell.z)};
  highest_ = {std::max(highest_.x, cell.x), std::max(highest_.y, cell.y),
              std::max(highest_.z, cell.z)};
}

void VertexGrid::erase(std::uint32_t id, const Vec3& position) {
  std::erase_if(voxels_[cell_of(position)], [id](const Entry& entry) { return entry.id == id; });
}

void VertexGrid::query(const Vec3& center, double radius, std::vector<std::uint32_t>& ids) const {
  ids.clear();
  const Vec3 reach{radius, radius, radius};
  const Cell lower = cell_of(center - reach), upper = cell_of(center + reach);
  for (auto z = std::max(lower.z, lowest_.z); z <= std::min(upper.z, highest_.z); ++z) {
    for (auto y = std::max(lower.y, lowest_.y); y <= std::min(upper.y, highest_.y); ++y) {
      for (auto x = std::max(lower.x, lowest_.x); x <= std::min(upper.x, highest_.x); ++x) {
        const auto voxel = voxels_.find({x, y, z});
        if (voxel == voxels_.end()) continue;
        for (const Entry& entry : voxel->second) {
          if (length_squared(entry.position - center) <= radius * radius) ids.push_back(entry.id);
        }
      }
    }
  }
}

}  // namespace isolux
