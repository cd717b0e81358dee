#include "isolux/discretization/facet_grids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isolux {
namespace {

Vec3 middle_of(const Triangulation& mesh) {
  Bounds bounds;
  for (const Vertex& vertex : mesh.vertices()) {
    if (!vertex.triangles.empty()) bounds.include(vertex.position);
  }
  return bounds.empty() ? Vec3{} : bounds.center();
}

}  // namespace

FacetGrids::FacetGrids(const Triangulation& mesh) : middle_(middle_of(mesh)) {
  std::vector<TriangleId> living;
  std::vector<Bounds> boxes;
  for (TriangleId id = 0; id < mesh.triangles().size(); ++id) {
    if (!mesh.triangle(id).alive || !(mesh.triangle(id).area > 0)) continue;
    living.push_back(id);
    boxes.push_back(facet_box(mesh, id, middle_));
  }
  const std::vector<int> grids = choose_grids(boxes);
  // Those of one voxel one after the other.
  std::vector<std::pair<VoxelKey, std::size_t>> order;
  for (std::size_t i = 0; i < living.size(); ++i) {
    order.emplace_back(voxel_of(boxes[i].center(), grids[i]), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<VoxelTable::Entry> entries;
  facets_.reserve(order.size());
  for (const auto& [key, i] : order) {
    const auto index = static_cast<std::uint32_t>(facets_.size());
    facets_.push_back(facet_of(mesh, living[i], middle_));
    const std::uint32_t object = facets_.back().object;
    if (object >= of_object_.size()) of_object_.resize(object + 1);
    of_object_[object] |= static_cast<GridSet>(1u << grids[i]);
    list(boxes[i], grids[i], index, entries);
  }
  voxels_ = VoxelTable(entries);
}

/// The grid of each triangle, by the power of two of its size; voxels are a quarter to half as
/// large as the triangles. At most kMostGrids grids: the finest takes all that is smaller.
std::vector<int> FacetGrids::choose_grids(std::span<const Bounds> boxes) {
  constexpr int kMostGrids = 12;
  std::vector<int> exponents;
  for (const Bounds& box : boxes) exponents.push_back(std::ilogb(box.diagonal()));
  if (exponents.empty()) return {};
  const int largest = *std::max_element(exponents.begin(), exponents.end());
  std::array<int, kMostGrids> number;
  number.fill(-1);
  for (int& e : exponents) {
    e = std::min(largest - e, kMostGrids - 1);
    number[static_cast<std::size_t>(e)] = 0;
  }
  for (int k = 0; k < kMostGrids; ++k) {
    int& grid = number[static_cast<std::size_t>(k)];
    if (grid < 0) continue;
    grid = count();
    scales_.push_back(1 / std::ldexp(0.5, largest - k));
  }
  for (int& e : exponents) e = number[static_cast<std::size_t>(e)];
  return exponents;
}

/// Lists a facet in the voxels from which it may be found: those that its box touches, but for
/// such that lie wholly outside one of its sides, or beyond its reach.
void FacetGrids::list(const Bounds& box, int grid, std::uint32_t index,
                      std::vector<VoxelTable::Entry>& entries) const {
  constexpr double kOutside = Facet::kOutside;
  constexpr double kRoom = 1.01;  // for rounding
  const double scale = scales_[static_cast<std::size_t>(grid)];
  const Facet& facet = facets_[index];
  const auto wide = [](const Vec3f& v) { return Vec3{v.x, v.y, v.z}; };
  const Vec3 corner = wide(facet.corner), up = wide(facet.up);
  const Vec3 along1 = wide(facet.along[0]), along2 = wide(facet.along[1]);
  // How far what is linear may be off its value in the middle of a voxel.
  const auto spread = [&](const Vec3& gradient) {
    return 0.5 * kRoom / scale *
           (std::abs(gradient.x) + std::abs(gradient.y) + std::abs(gradient.z));
  };
  const double least1 = -kRoom * kOutside - spread(along1);
  const double least2 = -kRoom * kOutside - spread(along2);
  const double most12 = 1 + kRoom * kOutside + spread(along1 + along2);
  const double highest = kRoom + spread(up);
  const auto middle = [&](std::int64_t k) {
    return (static_cast<double>(k) + 0.5 - kMiddleCell) / scale;
  };
  for (auto z = cell(box.lower.z * scale); z <= cell(box.upper.z * scale); ++z) {
    for (auto y = cell(box.lower.y * scale); y <= cell(box.upper.y * scale); ++y) {
      for (auto x = cell(box.lower.x * scale); x <= cell(box.upper.x * scale); ++x) {
        const Vec3 d = Vec3{middle(x), middle(y), middle(z)} - corner;
        const double w1 = dot(along1, d), w2 = dot(along2, d);
        if (w1 < least1 || w2 < least2 || w1 + w2 > most12 || std::abs(dot(up, d)) > highest) {
          continue;
        }
        entries.emplace_back(voxel_key(grid, x, y, z), index);
      }
    }
  }
}

}  // namespace isolux
