#pragma once

#include "isolux/formats/openscad/make.h"

namespace isolux::openscad {

/// The solid of a linear_extrude or rotate_extrude with what is drawn inside it, seen through the
/// map (m). Unions, differences and intersections of flat shapes become those of their solids.
/// `depth` is how deep it stands in others of them. Null where it has no volume.
ShapePtr extrusion(const Context& context, const Node& node, const Affine& map, int depth);

/// Whether the node is one.
bool is_extrusion(const Node& node);

/// Whether the node is a flat shape, which has no volume unless it is extruded.
bool is_flat_shape(const Node& node);

}  // namespace isolux::openscad
