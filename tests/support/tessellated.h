#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/triangle_mesh.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// A point of the outline of a solid of revolution, m.
struct OutlinePoint {
  double radius, height;
};

/// The solid that `outline`, which begins and ends on the axis and runs upward outside, sweeps
/// about it, as a closed mesh with `segments` flat sides; its points lie on the true surface.
inline std::shared_ptr<const Shape> revolved(const Vec3& foot, const Vec3& axis,
                                             const std::vector<OutlinePoint>& outline,
                                             std::uint32_t segments) {
  const Frame frame(normalized(axis));
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto at = [&](std::uint32_t ring, std::uint32_t k) {
    return ring * segments + k % segments;
  };
  for (const auto& [radius, height] : outline) {
    for (std::uint32_t k = 0; k < segments; ++k) {
      const double phi = 2 * std::numbers::pi * k / segments;
      points.push_back(foot +
                       frame.to_world({radius * std::cos(phi), radius * std::sin(phi), height}));
    }
  }
  for (std::uint32_t ring = 0; ring + 1 < outline.size(); ++ring) {
    for (std::uint32_t k = 0; k < segments; ++k) {
      const std::uint32_t a = at(ring, k), b = at(ring, k + 1), c = at(ring + 1, k + 1),
                          d = at(ring + 1, k);
      if (outline[ring].radius > 0) triangles.push_back({a, b, c});
      if (outline[ring + 1].radius > 0) triangles.push_back({a, c, d});
    }
  }
  return std::make_shared<TriangleMesh>(points, triangles);
}

/// The scene with its spheres and closed cylinders cut into flat triangles, `segments` around.
inline Scene tessellated(Scene scene, std::uint32_t segments) {
  for (Object& object : scene.objects) {
    const ShapeDescription shape = object.shape->describe();
    if (shape.transform) continue;
    std::vector<OutlinePoint> outline;
    if (shape.kind == "sphere") {
      const double radius = *shape.find<double>("radius");
      for (std::uint32_t k = 0; k <= segments / 2; ++k) {
        const double theta = 2 * std::numbers::pi * k / segments;
        const bool pole = k == 0 || k == segments / 2;
        outline.push_back({pole ? 0 : radius * std::sin(theta), -radius * std::cos(theta)});
      }
      object.shape = revolved(*shape.find<Vec3>("center"), {0, 0, 1}, outline, segments);
    } else if (shape.kind == "cylinder" && !shape.flag("open")) {
      const Vec3 from = *shape.find<Vec3>("from"), axis = *shape.find<Vec3>("to") - from;
      const double radius = *shape.find<double>("radius"), height = length(axis);
      object.shape =
          revolved(from, axis, {{0, 0}, {radius, 0}, {radius, height}, {0, height}}, segments);
    }
  }
  return scene;
}

}  // namespace isolux
