#pragma once

#include "isolux/discretization/facet.h"
#include "isolux/discretization/voxel_table.h"

namespace isolux {

/// The living triangles of a mesh as it stood when this was built, listed by the voxels from which
/// they may be found, in one grid for each size of triangle.
class FacetGrids {
 public:
  using GridSet = std::uint16_t;  ///< grids, by bits
  static constexpr GridSet kAll = 0xffff;

  explicit FacetGrids(const Triangulation& mesh);

  int count() const { return static_cast<int>(scales_.size()); }

  /// Those that facets of the object are in.
  GridSet of_object(std::uint32_t object) const {
    return object < of_object_.size() ? of_object_[object] : GridSet{};
  }

  /// The middle of the mesh, from which all coordinates count below, m.
  const Vec3& middle() const { return middle_; }

  /// The voxel of a grid that a point lies in.
  VoxelKey voxel_of(const Vec3& from_middle, int grid) const {
    const double scale = scales_[static_cast<std::size_t>(grid)];
    return voxel_key(grid, cell(from_middle.x * scale), cell(from_middle.y * scale),
                     cell(from_middle.z * scale));
  }

  /// The numbers of the facets that may be found from each voxel, in ascending order.
  const VoxelTable& voxels() const { return voxels_; }

  /// Facets near each other have numbers near each other.
  std::span<const Facet> facets() const { return facets_; }

 private:
  // The cell of a coordinate counted in voxels, within 2⁴⁰ of them: the next lower whole number,
  // but for rounding.
  static constexpr double kMiddleCell = 0x1p40 + 0x1p19;
  static std::int64_t cell(double coordinate) {
    return static_cast<std::int64_t>(coordinate + kMiddleCell);
  }

  std::vector<int> choose_grids(std::span<const Bounds> boxes);
  void list(const Bounds& box, int grid, std::uint32_t index,
            std::vector<VoxelTable::Entry>& entries) const;

  Vec3 middle_;
  std::vector<double> scales_;      // by grid: voxels per m
  std::vector<GridSet> of_object_;  // by object
  std::vector<Facet> facets_;
  VoxelTable voxels_;
};

}  // namespace isolux
