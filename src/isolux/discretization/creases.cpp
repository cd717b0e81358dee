#include "isolux/discretization/cover_points.h"

namespace isolux {
namespace {

// A crease is followed at this many steps inside it.
constexpr double kAside = 0.25;
// What a walk leads to is of the same sheet as a point, or that point itself, if no further from it
// than these parts of the size.
constexpr double kSameSheet = 0.02, kSamePoint = 1e-3;

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double t = std::clamp(dot(p - a, ab) / std::max(length_squared(ab), 1e-300), 0.0, 1.0);
  return distance(p, a + ab * t);
}

}  // namespace

/// Whether a point lies on the surface of `q`, rather than on a sheet close by: walking over from
/// there leads to it. Where it is higher than the surface has turned, it must do so exactly, with
/// nothing between.
bool CoverPoints::on_sheet_of(const CoverPoint& q, const SurfacePoint& point) const {
  const auto there = walk_.over(q, point.position);
  if (!there) return false;
  const double off = distance(there->position, point.position);
  if (level(q, point)) return off < kSameSheet * q.size;
  return off < kSamePoint * q.size && walk_.open(q, point);
}

/// Whether the crease is traced already where `point` lies on it, `outward` across it.
bool CoverPoints::known(const SurfacePoint& point, const Vec3& outward) const {
  thread_local std::vector<std::uint32_t> ids;
  ids.clear();
  crease_grid_.query(point.position, 1.7 * spacing_, 1.7, ids);
  return std::any_of(ids.begin(), ids.end(), [&](std::uint32_t id) {
    const CoverPoint& q = points_[id];
    if (dot(q.normal, point.normal) < walk_.cos_normal_tolerance()) return false;
    if (dot(q.inward, outward) > -0.3) return false;
    const double near = 0.08 * q.size;
    if (distance(q.position, point.position) < near) return on_sheet_of(q, point);
    return std::any_of(along_crease_[id].begin(), along_crease_[id].end(), [&](std::uint32_t r) {
      return distance_to_segment(point.position, q.position, points_[r].position) < near &&
             dot(point.position - q.position, q.inward) < near && on_sheet_of(q, point);
    });
  });
}

/// The direction across the crease at a rim reached in `direction`, by two rims beside it, so close
/// that no corner lies between.
std::optional<Vec3> CoverPoints::outward_at(const ZonePoint& rim, const Vec3& direction,
                                            double size) const {
  const double finest = 20 * fineness(size), aside = std::max(0.02 * size, finest);
  const Vec3 forward = tangential(direction, rim.normal), left = cross(rim.normal, forward);
  const auto back = walk_.over(rim, rim.position - forward * aside);
  if (!back) return std::nullopt;
  std::array<std::optional<Vec3>, 2> beside;
  double guess = aside;
  for (int side = 0; side < 2; ++side) {
    const auto start = walk_.step(*back, back->position + left * (side == 0 ? -aside : aside));
    if (!start) continue;
    const Vec3 ahead = tangential(forward, start->normal);
    const double far = 4 * aside;
    if (walk_.step(*start, start->position + ahead * far)) continue;
    const Rim ends = walk_.rim(*start, ahead, 0, far, fineness(size), guess);
    beside[side] = ends.point.position;
    guess = 2 * aside - ends.distance;
  }
  const bool straight = beside[0] && beside[1] &&
                        distance_to_segment(rim.position, *beside[0], *beside[1]) < 0.03 * aside;
  if (!straight && aside > 4 * finest) return outward_at(rim, direction, size / 8);
  if (!beside[0] && !beside[1]) return std::nullopt;
  Vec3 along = beside[1].value_or(rim.position) - beside[0].value_or(rim.position);
  if (beside[0] && beside[1] && !straight) along = *beside[1] - rim.position;  // of two, one
  const Vec3 outward = tangential(cross(along, rim.normal), rim.normal);
  if (!(dot(outward, forward) > 0.05)) return std::nullopt;
  return outward;
}

/// The spacing at a point of a crease, seen from a hair inside.
PointSpacing CoverPoints::spacing_inside(const CreasePoint& crease, double limit) {
  std::optional<ZonePoint> inside;
  double hair = 0.1 * limit;
  while (!inside && hair > 5e-4 * limit) {
    hair *= 0.2;
    inside = walk_.over(crease.point, crease.point.position - crease.outward * hair);
  }
  if (!inside) return {limit};
  const Vec3 outward = tangential(crease.outward, inside->normal);
  return graded(*inside, look_around(*inside, outward, {limit}, hair));
}

/// The point of the crease a step further on; nothing where it turns away, or something stands in
/// the way.
std::optional<CoverPoints::CreasePoint> CoverPoints::next_on_crease(const CreasePoint& from,
                                                                    const Vec3& along,
                                                                    double step) const {
  const double aside = kAside * step * from.spacing.measure(along);
  const auto inside = walk_.over(from.point, from.point.position - from.outward * aside);
  if (!inside) return std::nullopt;
  const auto ahead =
      walk_.step(*inside, inside->position + tangential(along, inside->normal) * step);
  if (!ahead) return std::nullopt;
  const Vec3 outward = tangential(from.outward, ahead->normal);
  if (walk_.step(*ahead, ahead->position + outward * (2.2 * aside))) return std::nullopt;
  const Rim rim = walk_.rim(*ahead, outward, 0, 2.2 * aside, fineness(step), aside);
  return CreasePoint{rim.point, outward, from.spacing};
}

/// The corner where the crease of `a`, followed in `along`, meets the crease of `b`; nothing where
/// there is none: they are parts of one round crease.
std::optional<CoverPoints::CreasePoint> CoverPoints::corner(const CreasePoint& a, const Vec3& along,
                                                            const CreasePoint& b,
                                                            double step) const {
  const double slope = dot(along, b.outward);
  if (std::abs(slope) < 0.05) return std::nullopt;
  const double x = dot(b.point.position - a.point.position, b.outward) / slope;
  if (!(x > -0.02 * step && x < 1.6 * step)) return std::nullopt;
  const Vec3 outward = normalized(a.outward + tangential(b.outward, a.point.normal));
  if (length_squared(outward) < 0.5) return std::nullopt;
  const Vec3 meeting = a.point.position + along * x;
  const double across = step * a.spacing.measure(along);
  for (const double depth : {0.2 * across, 0.05 * across}) {
    const auto inside = walk_.over(a.point, meeting - outward * depth);
    if (!inside) continue;
    const Vec3 ahead = tangential(outward, inside->normal);
    if (walk_.step(*inside, inside->position + ahead * (2 * depth))) continue;
    const Rim rim = walk_.rim(*inside, ahead, 0, 2 * depth, fineness(across), depth);
    if (std::abs(rim.distance - depth) > 0.02 * across) continue;
    const double slant = std::max(0.1, dot(outward, a.outward));
    return CreasePoint{rim.point, ahead * slant, a.spacing, true, b.point, b.outward};
  }
  return std::nullopt;
}

/// The corner that ends a crease after at most `step`: where something stands in the way, or
/// back from beyond, where the crease turns away.
std::optional<CoverPoints::CreasePoint> CoverPoints::corner_ahead(const CreasePoint& from,
                                                                  const Vec3& along, double step,
                                                                  double reached) const {
  const double aside = kAside * std::max(reached, 0.1 * step) * from.spacing.measure(along);
  const auto inside = walk_.over(from.point, from.point.position - from.outward * aside);
  if (!inside) return std::nullopt;
  const auto meet = [&](const ZonePoint& start, const Vec3& direction,
                        double length) -> std::optional<CreasePoint> {
    if (walk_.step(start, start.position + direction * length)) return std::nullopt;
    const Rim rim = walk_.rim(start, direction, 0, length, fineness(step));
    const auto outward = outward_at(rim.point, direction, from.spacing.size);
    if (!outward) return std::nullopt;
    return corner(from, along, {rim.point, *outward, from.spacing}, step);
  };
  const Vec3 ahead = tangential(along, inside->normal);
  if (auto found = meet(*inside, ahead, 1.5 * step)) return found;
  const auto past = walk_.step(*inside, inside->position + ahead * (reached + 0.3 * step));
  if (!past) return std::nullopt;
  const Vec3 across = tangential(from.outward, past->normal);
  const auto out = walk_.step(*past, past->position + across * (2 * aside));
  if (!out) return std::nullopt;
  return meet(*out, -tangential(along, out->normal), step);
}

}  // namespace isolux
