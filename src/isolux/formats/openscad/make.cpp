#include "isolux/formats/openscad/make.h"

#include <numbers>

#include "isolux/geometry/instance.h"

namespace isolux::openscad {

ShapePtr placed(const Context& context, const Node& node, ShapePtr shape, const Affine& map) {
  if (!shape || (map.linear == Affine{}.linear && map.translation == Vec3{})) return shape;
  return make<Instance>(context, node, std::move(shape), map);
}

ShapePtr combined(const Context& context, const Node& node, CsgOperation operation,
                  const std::vector<ShapePtr>& solids) {
  const bool first_is_gone = solids.empty() || !solids.front();
  if (operation == CsgOperation::subtract && first_is_gone) return nullptr;
  std::vector<ShapePtr> present;
  Bounds common;
  for (const ShapePtr& solid : solids) {
    if (!solid && operation == CsgOperation::intersect) return nullptr;
    if (!solid) continue;
    if (!solid->solid()) {
      context.tree.fail(node.place, fmt::format("{} takes closed solids only: a 'polyhedron' in "
                                                "it has edges without a second face",
                                                in_quotes(node.name)));
    }
    const Bounds box = solid->bounds();
    common =
        present.empty() ? box : Bounds{max(common.lower, box.lower), min(common.upper, box.upper)};
    if (operation == CsgOperation::intersect && common.empty()) return nullptr;
    present.push_back(solid);
  }
  if (present.empty()) return nullptr;
  try {
    return join(operation, present);
  } catch (const InputError& error) {
    context.tree.fail(node.place,
                      fmt::format("{} can't be made: {}", in_quotes(node.name), error.what()));
  }
}

int corner_count(const Arguments& arguments) {
  constexpr double kMost = 8;
  const double wanted = arguments.number("$fn", 0);
  return wanted >= 3 && wanted < kMost + 1 ? static_cast<int>(wanted) : 0;
}

std::vector<Vec3> regular_polygon(double radius, int corners) {
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return points;
}

}  // namespace isolux::openscad
