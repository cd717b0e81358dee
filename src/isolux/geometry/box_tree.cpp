#include "isolux/geometry/box_tree.h"

#include <algorithm>
#include <numeric>

namespace isolux {

BoxTree::BoxTree(std::span<const Bounds> boxes) : order_(boxes.size()) {
  constexpr std::uint32_t kLeaf = 4;
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(boxes.size())});
  for (std::size_t at = 0; at < nodes_.size(); ++at) {
    const auto [box, first, count] = nodes_[at];
    Bounds all, centers;
    for (std::uint32_t i = first; i < first + count; ++i) {
      all.include(boxes[order_[i]]);
      centers.include(boxes[order_[i]].center());
    }
    nodes_[at].box = all;
    if (count <= kLeaf) continue;
    const Vec3 size = centers.upper - centers.lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto begin = order_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count,
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double x = boxes[a].center()[axis], y = boxes[b].center()[axis];
                       return x != y ? x < y : a < b;
                     });
    nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[at].count = 0;
    nodes_.push_back({{}, first, count / 2});
    nodes_.push_back({{}, first + count / 2, count - count / 2});
  }
}

}  // namespace isolux
