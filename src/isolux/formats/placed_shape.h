#pragma once

#include <functional>
#include <memory>

#include "isolux/core/affine.h"
#include "isolux/formats/face.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// A surface of a file as a map places it; null where it is too small to have an area. A map that
/// keeps angles is applied to its numbers, others show round surfaces as instances of one shape.
/// Throws InputError, without a place, where the numbers make no shape.
using PlacedShape = std::function<std::shared_ptr<const Shape>(const Affine& map)>;

// Lengths in m. Negative radii stand for the same surface facing inward, open.

PlacedShape placed_ball(const Vec3& center, double radius);
/// An open tube whose ends are points with radii.
PlacedShape placed_tube(const Vec3& start, const Vec3& end, double start_radius, double end_radius);
/// A disk, or an annulus, that faces along `normal`, of any length but 0.
PlacedShape placed_ring(const Vec3& center, const Vec3& normal, double inner_radius,
                        double outer_radius);
/// With 0 ≤ inner_radius ≤ outer_radius, the least and greatest distances from the axis; `inward`
/// turns it over.
PlacedShape placed_torus(const Vec3& center, const Vec3& axis, double inner_radius,
                         double outer_radius, bool inward);
PlacedShape placed_face(const Region& region);

/// The same for a surface that stands in several places: where it takes more numbers than a
/// placement does, all of these show one shape.
PlacedShape shared(PlacedShape surface);

/// Whether that is too short to be told from 0.
bool is_short(double length);

}  // namespace isolux
