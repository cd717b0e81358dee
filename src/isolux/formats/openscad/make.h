#pragma once

#include <fmt/format.h>

#include <memory>

#include "isolux/formats/notes.h"
#include "isolux/formats/openscad/arguments.h"
#include "isolux/geometry/csg.h"
#include "isolux/scene/spelling.h"

namespace isolux::openscad {

using ShapePtr = std::shared_ptr<const Shape>;  ///< null for what has no volume

/// What all that makes shapes needs to know.
struct Context {
  const Tree& tree;
  double unit;  ///< m, of the file
  Notes& notes;
};

/// Makes a shape; what its constructor has against the numbers is reported at the node.
template <typename T, typename... Numbers>
ShapePtr make(const Context& context, const Node& node, Numbers&&... numbers) {
  try {
    return std::make_shared<T>(std::forward<Numbers>(numbers)...);
  } catch (const InputError& error) {
    context.tree.fail(node.place,
                      fmt::format("{} can't be made: {}", in_quotes(node.name), error.what()));
  }
}

/// The shape moved by the map.
ShapePtr placed(const Context& context, const Node& node, ShapePtr shape, const Affine& map);

/// One solid of those that are not null, in place of OpenSCAD's operator: null where nothing is
/// left.
ShapePtr combined(const Context& context, const Node& node, CsgOperation operation,
                  const std::vector<ShapePtr>& solids);

/// The number of corners that a circle is meant to have: `$fn` from 3 to 8 asks for a polygon, 0 is
/// a true circle.
int corner_count(const Arguments& arguments);

/// The corners of a regular polygon in a circle, the first along x, as OpenSCAD has them.
std::vector<Vec3> regular_polygon(double radius, int corners);

}  // namespace isolux::openscad
