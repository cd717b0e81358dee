#include <numbers>

#include "isolux/discretization/cover_points.h"

namespace isolux {
namespace {

// Neighbours are this part of the radius of curvature times α_n apart, so that Delaunay edges,
// which are up to 1.7 times as long, keep within α_n.
constexpr double kTurnPerSize = 0.55;
// Size in a strip, in widths of it; not less than this part of the spacing.
constexpr double kStripWidths = 2;
constexpr double kLeastStrip = 1.0 / 32;
// No curvature makes points finer than this part of the largest size on their object, and no edge
// between flat parts than that one.
constexpr double kLeastSize = 1.0 / 64, kLeastAcross = 1.0 / 1024;  // of all; across rulings
constexpr double kLeastAtFolds = 1.0 / 8;
// Along a ruling, points are no further apart than this part of the spacing.
constexpr double kLongest = 0.25;
constexpr double kLeastStretch = 4;
constexpr int kDirections = 8;
constexpr double kTau = 2 * std::numbers::pi;

/// How a surface bends around a point, from the turns of its normal on the way to other points.
class Bending {
 public:
  /// `u`, `v`: unit, tangential, perpendicular.
  Bending(const Vec3& u, const Vec3& v) : u_(u), v_(v) {}

  /// `turn`: the change of the normal a metre, 1/m.
  void add(const Vec3& turn) {
    const double x = dot(turn, u_), y = dot(turn, v_);
    xx_ += x * x, xy_ += x * y, yy_ += y * y;
    most_ = std::max(most_, length(turn));
  }

  /// The direction that it bends least in, and by what part of its most.
  std::pair<Vec3, double> least() const {
    const double mean = (xx_ + yy_) / 2, half = std::hypot((xx_ - yy_) / 2, xy_);
    const double angle = 0.5 * std::atan2(2 * xy_, xx_ - yy_) + std::numbers::pi / 2;
    return {u_ * std::cos(angle) + v_ * std::sin(angle),
            std::sqrt(std::max(0.0, mean - half) / std::max(mean + half, 1e-300))};
  }

  double most() const { return most_; }  // 1/m

 private:
  Vec3 u_, v_;
  double xx_ = 0, xy_ = 0, yy_ = 0, most_ = 0;
};

}  // namespace

/// Whether most of the turn on the way from a point to `there`, `away` from it in direction d, is
/// made at one edge between flat parts, which finer points would not make any flatter.
bool CoverPoints::turns_at_once(const ZonePoint& point, const ZonePoint& there, double away,
                                const Vec3& d) const {
  constexpr int kHalvings = 4;
  constexpr double kMost = 0.6;
  double near = 0, far = away;
  Vec3 before = point.normal, behind = there.normal;
  for (int i = 0; i < kHalvings; ++i) {
    const double t = (near + far) / 2;
    const auto found = walk_.step(point, point.position + d * t);
    if (!found) return true;  // the walk over a round surface is not broken off
    if (angle_between(found->normal, before) < angle_between(found->normal, behind)) {
      near = t, before = found->normal;
    } else {
      far = t, behind = found->normal;
    }
  }
  return angle_between(before, behind) > kMost * angle_between(there.normal, point.normal);
}

/// Whether the surface ends in direction d, where it runs on as far as `near` and not as far as
/// `far`, and where: it does not go on from there by the length `past`, in which it must not turn
/// by α_n. `guess`: where it may end, if not negative; `rim`: the last point of the walk, crease or
/// not.
CoverPoints::Ending CoverPoints::ending(const ZonePoint& point, const Vec3& d, double near,
                                        double far, double past, double guess, Rim& rim) const {
  rim = walk_.rim(point, d, near, far, past / 4, guess);
  const Vec3 on = tangential(d, rim.point.normal);
  const bool ends = !walk_.step(rim.point, rim.point.position + on * past);
  return {d, ends ? rim.distance : std::numeric_limits<double>::infinity(), rim.point};
}

/// `first`: the tangential unit direction to begin with, in which a crease is `crease_ahead` away
/// (m), across it, if that is not negative.
CoverPoints::Surroundings CoverPoints::look_around(const ZonePoint& point, const Vec3& first,
                                                   const PointSpacing& most, double crease_ahead) {
  constexpr double kNear = 0.35;
  const double limit = most.size;
  const Vec3 second = cross(point.normal, first);
  Surroundings around{{limit}};
  Bending bending(first, second);
  const double most_turn = kTurnPerSize * walk_.normal_tolerance();
  double curvature = 0, fold = 0;
  // Over an edge so blunt that it counts as smooth, less turn than that would read as curvature.
  const auto see_turn = [&](const ZonePoint& there, double away, const Vec3& d) {
    bending.add((there.normal - point.normal) / away);
    const double turn = angle_between(there.normal, point.normal);
    if (turn <= most_turn) return;
    double& bend = turns_at_once(point, there, away, d) ? fold : curvature;
    bend = std::max(bend, turn / away);
  };
  std::array<double, kDirections> ends;
  ends.fill(std::numeric_limits<double>::infinity());
  for (int k = 0; k < kDirections; ++k) {
    const double angle = kTau * k / kDirections;
    const Vec3 d = first * std::cos(angle) + second * std::sin(angle);
    double near = 0, far = 0;
    for (const double t : {kNear * limit, limit}) {
      const auto found = walk_.step(point, point.position + d * t);
      if (!found) {
        far = t;
        break;
      }
      near = t;
      adjoin(point, *found);
      see_turn(*found, t, d);
    }
    if (far == 0) continue;
    Rim rim;
    const double guess = crease_ahead / std::cos(angle);
    const Ending end = ending(point, d, near, far, far / 16, guess, rim);
    if (rim.distance > 0) see_turn(rim.point, rim.distance, d);
    ends[k] = end.distance;
    if (std::isfinite(end.distance)) around.creases.push_back(end);
  }

  const double largest = largest_on(point), longest = std::min(kLongest * spacing_, largest);
  const auto [ruling, part] = bending.least();
  const double across = most_turn / std::max(bending.most(), 1e-30);
  const double along = std::min(across / std::max(part, 1e-30), longest);
  if (fold == 0 && along > kLeastStretch * across) {
    around.ruling = ruling, around.stretch = along / across;
  }
  const auto limited = [&](double bend, double least) {
    return std::clamp(most_turn / std::max(bend, 1e-30), std::min(limit, least), limit);
  };
  around.size =
      std::min(limited(curvature, (around.stretch > 1 ? kLeastAcross : kLeastSize) * largest),
               limited(fold, kLeastAtFolds * largest));
  for (int k = 0; k < kDirections / 2; ++k) {
    const auto shortest = [&](int i) {
      return ends[i] <= ends[(i + 1) % kDirections] &&
             ends[i] <= ends[(i + kDirections - 1) % kDirections];
    };
    const double width = ends[k] + ends[k + kDirections / 2];
    if (!std::isfinite(width) || !shortest(k) || !shortest(k + kDirections / 2)) continue;
    around.size = std::min(around.size,
                           std::max(kStripWidths * width, std::min(limit, kLeastStrip * spacing_)));
  }
  if (around.stretch == 1 && around.size == limit && most.stretch > 1) {
    const double far = std::min({most.longest(), largest, across});
    if (far > limit) {
      around.ruling = tangential(most.ruling, point.normal), around.stretch = far / limit;
    }
  }
  if (around.stretch > 1) look_along(point, around);
  for (const Ending& end : around.creases) {
    around.to_crease = std::min(around.to_crease, around.measure(end.direction * end.distance));
  }
  return around;
}

/// Where the surface ends along the ruling, further away than the rest was looked at.
void CoverPoints::look_along(const ZonePoint& point, Surroundings& around) const {
  for (const Vec3& d : {around.ruling, -around.ruling}) {
    const double far = 1.2 * around.longest();
    if (walk_.step(point, point.position + d * far)) continue;
    Rim rim;
    const Ending end = ending(point, d, 0, far, std::min(far / 16, around.size / 2), -1, rim);
    if (std::isfinite(end.distance)) around.creases.push_back(end);
  }
}

}  // namespace isolux
