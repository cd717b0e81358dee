#include "isolux/formats/rayshade/leaves.h"

namespace isolux::rayshade {
namespace {

void collect(const Node& node, Leaf around, std::vector<Leaf>& leaves) {
  around.node = &node;
  if (node.map) around.map = around.map * *node.map, around.moved = true;
  if (node.surface) around.surface = node.surface;
  if (!node.name.empty()) around.name = &node.name, around.alone = true;
  if (const auto* reference = std::get_if<Reference>(&node.geometry)) {
    collect(*reference->target, around, leaves);
  } else if (const auto* group = std::get_if<Group>(&node.geometry); group && !group->operation) {
    if (group->members.size() > 1) around.alone = false;
    for (const NodePtr& member : group->members) collect(*member, around, leaves);
  } else {
    leaves.push_back(around);
  }
}

Bounds mapped(const Bounds& box, const Affine& map) {
  Bounds result;
  if (box.empty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    result.include(
        map.point({corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
                   corner & 4 ? box.upper.z : box.lower.z}));
  }
  return result;
}

}  // namespace

std::vector<Leaf> leaves_of(const std::vector<NodePtr>& objects) {
  std::vector<Leaf> leaves;
  for (const NodePtr& object : objects) collect(*object, {}, leaves);
  return leaves;
}

Bounds FiniteBounds::of(const Leaf& leaf) { return mapped(of(*leaf.node), leaf.map); }

Bounds FiniteBounds::of(const Node& node) {
  const auto known = found_.find(&node);
  if (known != found_.end()) return known->second;
  return found_[&node] = find(node);
}

Bounds FiniteBounds::find(const Node& node) {
  if (const auto* shape = std::get_if<ShapePtr>(&node.geometry)) return (*shape)->bounds();
  if (const auto* tube = std::get_if<Tube>(&node.geometry)) return tube->side->bounds();
  if (const auto* disc = std::get_if<Disc>(&node.geometry)) return disc->shape->bounds();
  Bounds box;
  if (const auto* facets = std::get_if<Facets>(&node.geometry)) {
    for (const Vec3& p : facets->soup.points) box.include(p);
  } else if (const auto* reference = std::get_if<Reference>(&node.geometry)) {
    const Node& target = *reference->target;
    box = mapped(of(target), target.map.value_or(Affine{}));
  } else if (const auto* group = std::get_if<Group>(&node.geometry)) {
    for (const NodePtr& member : group->members) {
      box.include(mapped(of(*member), member->map.value_or(Affine{})));
      // What is taken away adds nothing.
      if (group->operation == CsgOperation::subtract && !box.empty()) break;
    }
  }
  return box;
}

}  // namespace isolux::rayshade
