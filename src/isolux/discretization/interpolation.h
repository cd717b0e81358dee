#pragma once

#include <array>
#include <span>

#include "isolux/discretization/triangulation.h"

namespace isolux {

/// A point of a surface, as light is read off the mesh there: three vertices and their weights,
/// which add up to 1 and none of which is negative.
struct MeshPlace {
  std::array<VertexId, 3> vertices{};
  std::array<double, 3> weights{};
};

/// The place of a point of the triangle, or of one that rounding has put next to it.
MeshPlace place_in(const Triangulation& mesh, TriangleId triangle, const Vec3& point);

/// Irradiance (lx) there, linear between the vertices.
Rgb interpolate_irradiance(const Triangulation& mesh, const MeshPlace& place);

/// Irradiance (lx) at a point that no triangle covers, from the vertices it would be connected
/// to: each weighs the angle it covers around the point, divided by its distance (§3.3.1). Zero
/// where there are none. `before_current_shot` leaves the current shot's part out.
Rgb extrapolate_irradiance(const Triangulation& mesh, const SurfacePoint& point,
                           std::span<const VertexId> neighbours, bool before_current_shot = false);

}  // namespace isolux
