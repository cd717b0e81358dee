#include "isolux/formats/placed_shape.h"

#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"
#include "isolux/scene/shape_writer.h"

namespace isolux {
namespace {

using ShapePtr = std::shared_ptr<const Shape>;

ShapePtr turned_over(ShapePtr shape) { return std::make_shared<Reversed>(std::move(shape)); }

/// What `make` builds from a map that keeps angles and its factor.
template <typename Make>
PlacedShape placed_round(const Make& make) {
  return [make, original = ShapePtr{}](const Affine& map) mutable -> ShapePtr {
    if (const auto factor = map.similarity()) return make(map, *factor);
    if (!original) original = make(Affine{}, 1);
    return original ? std::make_shared<Instance>(original, map) : nullptr;
  };
}

Region placed(const Region& region, const Affine& map) {
  Region result = region;
  const auto place = [&](Contour& contour) {
    for (Vec3& p : contour) {
      p = map.point(p);
      require_point(p, "vertex");
    }
    if (map.determinant() < 0) std::reverse(contour.begin(), contour.end());
  };
  place(result.outline);
  for (Contour& hole : result.holes) place(hole);
  return result;
}

}  // namespace

bool is_short(double length) { return !(std::abs(length) > 2 * kShortestLength); }

PlacedShape placed_ball(const Vec3& center, double radius) {
  return placed_round([=](const Affine& map, double factor) -> ShapePtr {
    if (is_short(radius * factor)) return nullptr;
    const auto ball = std::make_shared<Sphere>(map.point(center), std::abs(radius) * factor);
    return radius > 0 ? ball : turned_over(ball);
  });
}

PlacedShape placed_tube(const Vec3& start, const Vec3& end, double start_radius,
                        double end_radius) {
  return placed_round([=](const Affine& map, double factor) -> ShapePtr {
    const Vec3 a = map.point(start), b = map.point(end);
    double ra = std::abs(start_radius) * factor, rb = std::abs(end_radius) * factor;
    if (is_short(distance(a, b)) || is_short(std::max(ra, rb))) return nullptr;
    if (is_short(ra)) ra = 0;
    if (is_short(rb)) rb = 0;
    ShapePtr side;
    if (ra == rb) {
      side = std::make_shared<Cylinder>(a, b, ra, false);
    } else {
      side = std::make_shared<Frustum>(a, b, ra, rb, false);
    }
    return start_radius < 0 || end_radius < 0 ? turned_over(side) : side;
  });
}

PlacedShape placed_ring(const Vec3& center, const Vec3& normal, double inner_radius,
                        double outer_radius) {
  return placed_round([=](const Affine& map, double factor) -> ShapePtr {
    if (is_short((outer_radius - inner_radius) * factor)) return nullptr;
    const double hole = is_short(inner_radius * factor) ? 0 : inner_radius * factor;
    return std::make_shared<Disk>(map.point(center), map.vector(unit_vector(normal)),
                                  outer_radius * factor, hole);
  });
}

PlacedShape placed_torus(const Vec3& center, const Vec3& axis, double inner_radius,
                         double outer_radius, bool inward) {
  return placed_round([=](const Affine& map, double factor) -> ShapePtr {
    // A hole that is closed to a point is opened by a hair: such a torus cuts itself there.
    const double major = 0.5 * (inner_radius + outer_radius) * factor;
    const double minor = std::min(0.5 * (outer_radius - inner_radius) * factor, major * (1 - 1e-9));
    if (is_short(minor)) return nullptr;
    const auto ring =
        std::make_shared<Torus>(map.point(center), map.vector(unit_vector(axis)), major, minor);
    return inward ? turned_over(ring) : ring;
  });
}

PlacedShape placed_face(const Region& region) {
  return [region](const Affine& map) { return face_shape(placed(region, map)); };
}

PlacedShape shared(PlacedShape surface) {
  const ShapePtr original = surface(Affine{});
  if (!original || !is_worth_a_name(*original)) return surface;
  return [original](const Affine& map) { return std::make_shared<Instance>(original, map); };
}

}  // namespace isolux
