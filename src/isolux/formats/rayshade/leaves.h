#pragma once

#include <unordered_map>

#include "isolux/core/vec3.h"
#include "isolux/formats/rayshade/model.h"

namespace isolux::rayshade {

/// A node that becomes one object: no list, no reference.
struct Leaf {
  const Node* node = nullptr;
  Affine map;                         ///< from the node's frame, its own map included, to the world
  bool moved = false;                 ///< whether the map is more than the identity
  SurfacePtr surface;                 ///< nothing: Rayshade's default
  const std::string* name = nullptr;  ///< of the innermost named object around; or nothing
  bool alone = true;                  ///< whether the leaf is all of what is so named
};

/// All leaves of the objects, in order.
std::vector<Leaf> leaves_of(const std::vector<NodePtr>& objects);

/// Boxes around leaves, planes left aside.
class FiniteBounds {
 public:
  /// In the world.
  Bounds of(const Leaf& leaf);

 private:
  /// In the node's frame, its own map left aside.
  Bounds of(const Node& node);
  Bounds find(const Node& node);

  std::unordered_map<const Node*, Bounds> found_;
};

}  // namespace isolux::rayshade
