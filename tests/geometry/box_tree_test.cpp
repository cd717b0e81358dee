#include "isolux/geometry/box_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "isolux/core/random.h"

namespace isolux {
namespace {

TEST(BoxTree, FindsAllBoxesAroundAPoint) {
  for (const std::size_t count : {0u, 1u, 4u, 5u, 1000u}) {
    Random random(3);
    const auto point = [&] { return Vec3{random.uniform(), random.uniform(), random.uniform()}; };
    std::vector<Bounds> boxes(count);
    for (std::size_t i = 0; i < count; ++i) {
      boxes[i].include(i % 3 == 0 ? Vec3{0.5, 0.5, 0.5} : point());  // some at one place
      boxes[i].include(boxes[i].lower + point() * 0.3);
    }
    const BoxTree tree(boxes);
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = point();
      const auto around = [&](const Bounds& box) { return box.encloses({p, p}); };
      std::multiset<std::uint32_t> found, expected;
      EXPECT_FALSE(tree.any(around, [&](std::uint32_t k) {
        if (around(boxes[k])) found.insert(k);
        return false;
      }));
      for (std::uint32_t k = 0; k < count; ++k) {
        if (around(boxes[k])) expected.insert(k);
      }
      EXPECT_EQ(found, expected);
      EXPECT_EQ(tree.any(around, [&](std::uint32_t k) { return around(boxes[k]); }),
                !expected.empty());
    }
  }
}

}  // namespace
}  // namespace isolux
