#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// Two objects that should be apart.
struct ObjectPair {
  std::uint32_t first = 0, second = 0;

  auto operator<=>(const ObjectPair&) const = default;
};

/// What rays found of objects that share a place, each list in order and without repetition.
struct Contacts {
  /// first lies in the plane (or other surface) of second, facing alike, with all that it has: it
  /// is hidden, as second is the later in the scene.
  std::vector<ObjectPair> hidden;
  /// They face alike in one surface, and each sticks out of the other there.
  std::vector<ObjectPair> overlapping;
  std::vector<ObjectPair> crossing;  ///< their surfaces run through each other
  std::vector<ObjectPair> buried;    ///< all of first is inside the solid second
};

/// Looks at the points of each object (points_on_objects()): what lies in the same place, inside
/// which solids they are, and what stands across the straight line between two of one face. What
/// only touches, face to face, is as it should be; so is a light in a surface, and what lies whole
/// upon another. Small overlaps may be missed. Cost: n log n in the objects, times the length of
/// their lists.
Contacts find_contacts(const RayCaster& rays, std::span<const std::vector<Hit>> points);

}  // namespace isolux
