// Surfaces of revolution as NURBS: true circles, so that they are spheres, tori, cones ...
#pragma once

#include <cmath>
#include <memory>
#include <numbers>

#include "isolux/core/affine.h"
#include "isolux/geometry/nurbs.h"

namespace isolux {

/// A rational curve: its knots, and its control points.
struct RationalCurve {
  KnotVector knots;
  std::vector<ControlPoint> points;
};

/// An arc about (x, 0, 0) in the plane y = 0 from one to the other multiple of 45° above x, an even
/// number of them apart: a parabola's arc in homogeneous coordinates for each 90°.
inline RationalCurve arc(double x, double radius, int from, int to) {
  RationalCurve curve;
  curve.knots = {2, {0}};
  for (int k = from; k <= to; ++k) {
    const bool between = (k - from) % 2 != 0;
    const double angle = k * std::numbers::pi / 4;
    const double r = between ? radius * std::numbers::sqrt2 : radius;
    const auto whole = [&](double c) { return std::abs(c) < 1e-9 ? 0 : c; };
    curve.points.push_back({{x + r * whole(std::cos(angle)), 0, r * whole(std::sin(angle))},
                            between ? std::sqrt(0.5) : 1});
    curve.knots.knots.push_back((k - from) / 2);
  }
  const double last = (to - from) / 2;
  curve.knots.knots.insert(curve.knots.knots.end(), {last, last});
  return curve;
}

/// What a curve in the plane y = 0 sweeps about the z axis, moved: u goes around, v along the
/// curve. The front is to its right as it rises.
inline std::shared_ptr<const Nurbs> turned(const RationalCurve& curve, const Affine& map = {}) {
  const RationalCurve circle = arc(0, 1, 0, 8);
  Nurbs::Points points;
  Nurbs::Weights weights;
  for (const auto& [p, weight] : curve.points) {
    auto& row = points.emplace_back();
    auto& numbers = weights.emplace_back();
    for (const ControlPoint& c : circle.points) {
      row.push_back(map.point({p.x * c.place.x, p.x * c.place.z, p.z}));
      numbers.push_back(weight * c.weight);
    }
  }
  return std::make_shared<Nurbs>(circle.knots, curve.knots, points, weights);
}

/// A straight line.
inline RationalCurve line(const Vec3& from, const Vec3& to) {
  RationalCurve curve;
  curve.knots = {1, {0, 0, 1, 1}};
  curve.points = {{from}, {to}};
  return curve;
}

}  // namespace isolux
