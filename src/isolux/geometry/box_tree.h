#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/geometry/ray.h"

namespace isolux {

/// Whether the whole line passes through the box, sides included.
inline bool meets(const Ray& line, const Bounds& box) {
  double first = -std::numeric_limits<double>::infinity(), last = -first;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.lower[axis] - line.origin[axis];
    const double high = box.upper[axis] - line.origin[axis];
    if (line.direction[axis] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    const double a = low / line.direction[axis], b = high / line.direction[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  return first <= last;
}

/// Finds boxes among many: a binary tree, halved at the median along the longest side.
class BoxTree {
 public:
  /// At most 2³² − 1 boxes, none empty.
  explicit BoxTree(std::span<const Bounds> boxes);

  /// Calls visit(i) for box i of each leaf that `meets(box)` lets in; ends early, with true, where
  /// that returns true. meets() must hold for any box around one that it holds for.
  template <typename Meets, typename Visit>
  bool any(const Meets& meets, const Visit& visit) const {
    std::array<std::uint32_t, 64> open;  // deeper than any tree gets
    std::size_t count = 0;
    if (!nodes_.empty()) open[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[open[--count]];
      if (!meets(node.box)) continue;
      if (node.count == 0) {
        open[count++] = node.first + 1;
        open[count++] = node.first;
      }
      for (std::uint32_t i = 0; i < node.count; ++i) {
        if (visit(order_[node.first + i])) return true;
      }
    }
    return false;
  }

 private:
  struct Node {
    Bounds box;
    std::uint32_t first = 0;  ///< of a leaf, its first place in order_; else the first of two nodes
    std::uint32_t count = 0;  ///< of a leaf; else 0
  };

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> order_;  ///< numbers of boxes
};

}  // namespace isolux
