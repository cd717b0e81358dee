#pragma once

#include <span>

#include "isolux/discretization/mesh_rays.h"
#include "isolux/discretization/triangulation.h"

namespace isolux {

/// Irradiance (lx) in a triangle, linear between its vertices.
Rgb interpolate_irradiance(const Triangulation& mesh, const MeshHit& hit);

/// Irradiance (lx) at a point that no triangle covers, from the vertices it would be connected
/// to: each weighs the angle it covers around the point, divided by its distance (§3.3.1). Zero
/// where there are none. `before_current_shot` leaves the current shot's part out.
Rgb extrapolate_irradiance(const Triangulation& mesh, const SurfacePoint& point,
                           std::span<const VertexId> neighbours, bool before_current_shot = false);

}  // namespace isolux
