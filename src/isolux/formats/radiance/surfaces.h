#pragma once

#include <string_view>
#include <vector>

#include "isolux/formats/placed_shape.h"
#include "isolux/formats/radiance/scanner.h"

namespace isolux::radiance {

inline constexpr std::size_t kMostTriangles = 1'000'000;  ///< of all meshes

/// A surface, as read.
struct Surface {
  PlacedShape shape;
  std::size_t corners = 0;    ///< of a polygon
  std::size_t triangles = 0;  ///< of a mesh
  bool flat = true;           ///< its corners lie in a plane
};

/// Throws InputError, without a place, where the polygon falls apart or has more than 1000 corners.
Surface polygon(const std::vector<Vec3>& corners);

/// The names of the primitives that read_surface() reads.
const std::vector<std::string_view>& surface_types();

/// Throws InputError with the place where the numbers make no such surface.
Surface read_surface(const Primitive& primitive);

}  // namespace isolux::radiance
