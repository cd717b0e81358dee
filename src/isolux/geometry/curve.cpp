#include "isolux/geometry/curve.h"

namespace isolux {
namespace {

CurvePoint weighted(const CurvePoint& a, double wa, const CurvePoint& b, double wb,
                    const CurvePoint& c, double wc) {
  return {a.p * wa + b.p * wb + c.p * wc, a.radius * wa + b.radius * wb + c.radius * wc};
}

double knot_step(const CurvePoint& a, const CurvePoint& b) { return std::sqrt(distance(a.p, b.p)); }

/// The handle at `here` towards `next`, of the spline through the three.
CurvePoint handle(const CurvePoint& before, const CurvePoint& here, const CurvePoint& next) {
  const double d = knot_step(before, here), e = knot_step(here, next);
  const double whole = 3 * d * (d + e);
  return weighted(next, d * d / whole, here, (2 * d * d + 3 * d * e + e * e) / whole, before,
                  -e * e / whole);
}

}  // namespace

std::vector<CurveArc> curve_through(const std::vector<CurvePoint>& points, const CurvePoint& before,
                                    const CurvePoint& after) {
  std::vector<CurveArc> arcs;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const CurvePoint &a = points[i], &b = points[i + 1];
    const CurvePoint& left = i > 0 ? points[i - 1] : before;
    const CurvePoint& right = i + 2 < points.size() ? points[i + 2] : after;
    arcs.push_back({a, handle(left, a, b), handle(right, b, a), b});
  }
  return arcs;
}

CurvePoint straight_on(const CurvePoint& end, const CurvePoint& next) {
  return {end.p * 2 - next.p, end.radius * 2 - next.radius};
}

}  // namespace isolux
