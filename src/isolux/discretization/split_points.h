#pragma once

#include <array>

#include "isolux/discretization/triangulation.h"

namespace isolux {

/// The true surface point over the middle of an edge of a cover, for split_edge(): by a short ray
/// along the ends' mean normal; for an edge with one triangle, at the crease beside it, as far
/// inside as a thousandth of the edge. Nothing where the edge has no triangle or the surface isn't
/// there. Some 20 rays on creases, else one.
std::optional<SurfacePoint> point_over_edge(const Triangulation& mesh, const RayCaster& rays,
                                            VertexId a, VertexId b);

/// The true surface point over a triangle's point of these barycentric `weights`, along the
/// corners' mean normal; nothing where the surface isn't there.
std::optional<SurfacePoint> point_over_triangle(const Triangulation& mesh, const RayCaster& rays,
                                                TriangleId triangle,
                                                const std::array<double, 3>& weights);

}  // namespace isolux
