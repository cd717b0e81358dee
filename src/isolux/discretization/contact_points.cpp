#include "isolux/discretization/cover_points.h"

namespace isolux {

/// What another surface is like, seen from a point: how far it is along the normal, m, and by how
/// much further, a metre along the point's own.
std::optional<CoverPoints::Gap> CoverPoints::gap_over(const ZonePoint& point, double most) const {
  constexpr double kFacing = -0.7;  // cosine
  const RayCaster& rays = walk_.rays();
  const auto hit = rays.nearest({point.position, point.normal}, {rays.epsilon(), most});
  if (!hit) return std::nullopt;
  const double cosine = dot(hit->normal, point.normal);
  if (cosine > kFacing) return std::nullopt;
  return Gap{hit->t, (hit->normal - point.normal * cosine) / -cosine};
}

/// Where the surface beside a point touches another one, as a ball does the floor that it lies on:
/// a little before, where a walk still comes past. Light falls off towards there from all sides
/// alike, which points around would not tell. Near there the gap is quadratic in the distance.
std::optional<ZonePoint> CoverPoints::contact_beside(const CoverPoint& from) const {
  constexpr int kMostSteps = 4;
  constexpr double kClosed = 1e-3;  // of the gap that it begins with
  constexpr double kEnough = 4;     // times as wide as it should be
  auto gap = gap_over(from, from.size);
  if (!gap) return std::nullopt;
  const double closed = std::max(kClosed * gap->width, 32 * walk_.rays().epsilon());
  ZonePoint at = from;
  for (int i = 0; i < kMostSteps; ++i) {
    if (gap->width <= kEnough * closed) return at;
    const double slope = length(gap->slope);
    const double away = 2 * gap->width / slope;
    if (!(away < 2 * from.longest())) return std::nullopt;
    // The slope is to fall as fast as it should where they touch; where they cross it does not.
    const Vec3 toward = gap->slope * (-1 / slope);
    const auto half = walk_.step(at, at.position + toward * (away / 2));
    const double before = std::sqrt(closed / gap->width);
    const auto next = walk_.step(at, at.position + toward * ((1 - before) * away));
    if (!half || !next) return std::nullopt;
    const auto half_gap = gap_over(*half, from.size), next_gap = gap_over(*next, from.size);
    if (!half_gap || !next_gap) return std::nullopt;
    if (!(half_gap->width < gap->width && next_gap->width < half_gap->width)) return std::nullopt;
    at = *next, gap = next_gap;
  }
  return std::nullopt;
}

}  // namespace isolux
