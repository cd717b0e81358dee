#pragma once

#include "isolux/formats/mgf/contexts.h"
#include "isolux/formats/placed_shape.h"

namespace isolux::mgf {

/// A geometric entity, as read.
struct Surface {
  PlacedShape shape;
  std::size_t corners = 0;  ///< of a face or of the end of a prism
  bool flat = true;         ///< its corners lie in a plane
  bool smoothed = false;    ///< has vertex normals that are not those of the surface
};

/// Whether read_surface() knows the entity.
bool is_surface(std::string_view keyword);

Surface read_surface(const Statement& s, const Contexts<Vertex>& vertices);

}  // namespace isolux::mgf
