#pragma once

#include "isolux/formats/openscad/make.h"

namespace isolux::openscad {

/// The solid of a cube, sphere, cylinder or polyhedron, seen through the map (m): as numbers of its
/// own where it can be, else as an Instance. Null where it has no volume. A polyhedron whose faces
/// leave gaps is an open surface.
ShapePtr primitive(const Context& context, const Node& node, const Affine& map);

/// Whether the node is one.
bool is_primitive(const Node& node);

}  // namespace isolux::openscad
