// Creases followed from point to point, and what becomes of the points.

#include "isolux/discretization/cover_points.h"

namespace isolux {
namespace {

// Points on a crease are this many sizes inside it; never less than so many of the caster's
// epsilons.
constexpr double kInset = 1e-3;
constexpr double kInsetEpsilons = 10;
// A crease turns by at most this from point to point, rad; a disk then lacks 0.7 % of its area.
constexpr double kCreaseTurn = 0.2;
// Points on a crease are no closer than this part of the largest size on their object.
constexpr double kLeastStep = 0.02;
// Corners this close together, in sizes, are one, where they point the same way.
constexpr double kSame = 0.05;

/// By how much (rad) a crease may turn from point to point, a step (m) apart: more where it is
/// small beside `spacing`.
double most_turn(double step, double spacing) {
  constexpr double kSmall = 1.0 / 32, kMost = 0.42;
  return std::clamp(kCreaseTurn * kSmall * spacing / step, kCreaseTurn, kMost);
}

}  // namespace

void CoverPoints::CreasePoint::shorten(double most) {
  const double along = step(), squeeze = spacing.measure(left());
  if (along <= most) return;
  // Along the ruling, or across it.
  if (squeeze < 0.7 && most > spacing.size) {
    spacing.stretch = most / spacing.size;
  } else {
    spacing.size *= most / along;
  }
}

/// Whether the point lies on the chain already, its last points left out.
bool CoverPoints::met(const std::vector<CreasePoint>& chain, const CreasePoint& next, double step) {
  for (std::size_t i = 0; i + 3 < chain.size(); ++i) {
    if (distance(chain[i].point.position, next.point.position) < 0.55 * step &&
        dot(chain[i].outward, next.outward) > 0.5) {
      return true;
    }
  }
  return false;
}

/// Appends to `chain` the points of the crease from `from` (left out) on, as far as a corner, a
/// crease that is known, or round to the beginning of the chain.
void CoverPoints::follow(const CreasePoint& start, const Vec3& direction,
                         std::vector<CreasePoint>& chain, bool& closed) {
  CreasePoint from = start;
  Vec3 along = direction;
  const double least = kLeastStep * largest_on(start.point);
  for (;;) {
    from.spacing = spacing_inside(from, std::min(spacing_, 1.5 * from.step()));
    from.spacing.size *= std::max(1.0, least / from.step());
    const auto turned = [&](CreasePoint& next) -> double {
      const auto outward = outward_at(next.point, next.outward, from.spacing.size);
      if (!outward) return 10;
      next.outward = *outward;
      const Vec3 before = tangential(from.outward, next.point.normal);
      return angle_between(before, next.outward);
    };
    const auto along_at = [&](const CreasePoint& p) {
      const Vec3 left = p.left();
      return dot(left, along) > 0 ? left : -left;
    };
    const auto go_to_corner = [&](const CreasePoint& other, double length) {
      const auto meeting = corner(from, along, other, length);
      if (meeting) chain.push_back(*meeting);
      return meeting.has_value();
    };

    double step = from.step();
    const double most = most_turn(step, spacing_);
    auto next = next_on_crease(from, along, step);
    if (!next) {
      // As far as it goes; there, another crease should begin.
      double near = 0, far = step;
      std::optional<CreasePoint> last;
      while (far - near > 2e-3 * step) {
        const double middle = 0.5 * (near + far);
        if (const auto found = next_on_crease(from, along, middle)) {
          last = found, near = middle;
        } else {
          far = middle;
        }
      }
      // A round crease turned away: shorter steps follow it.
      if (near > least) {
        next = next_on_crease(from, along, 0.7 * near);
        CreasePoint there = next.value_or(from);
        if (next && turned(there) > most) {
          step = 0.7 * near;
        } else {
          next.reset();
        }
      }
      if (!next) {
        if (const auto meeting = corner_ahead(from, along, step, near)) {
          chain.push_back(*meeting);
          return;
        }
        if (!last || near < 0.2 * step) return;
        next = last, step = near;
      }
    }
    double turn = turned(*next);
    if (turn > 1.1 * most) {
      if (turn < 9 && go_to_corner(*next, step)) return;
      for (int halving = 0; halving < 8 && turn > 1.1 * most; ++halving) {
        step *= std::clamp(0.95 * most / turn, 0.25, 0.7);
        next = next_on_crease(from, along, step);
        if (!next) return;
        turn = turned(*next);
        if (turn > 1.1 * most && turn < 9 && go_to_corner(*next, step)) return;
      }
      if (turn > 1.1 * most || step < least) return;
      next->shorten(step);
    }
    adjoin(from.point, next->point);
    // Round to where the chain began?
    if (chain.size() >= 3 &&
        distance(next->point.position, chain.front().point.position) < 0.7 * step &&
        dot(next->outward, chain.front().outward) > 0.5) {
      closed = true;
      return;
    }
    if (known(next->point, next->outward) || met(chain, *next, step)) return;
    along = along_at(*next);
    chain.push_back(*next);
    from = *next;
  }
}

/// Moves the point before the chain's last corner where it came too close to that, or drops it.
void CoverPoints::even_out(std::vector<CreasePoint>& chain) const {
  const std::size_t n = chain.size();
  if (n < 3 || !chain[n - 1].corner || chain[n - 2].corner) return;
  const CreasePoint& before = chain[n - 3];
  const Vec3 corner = chain[n - 1].point.position;
  const double left = distance(chain[n - 2].point.position, corner);
  const double step = chain[n - 2].step();
  if (left > 0.6 * step) return;
  const Vec3 way = corner - before.point.position;
  const double half = 0.5 * length(way);
  if (half < 0.6 * step) {
    chain.erase(chain.end() - 2);
  } else if (auto middle = next_on_crease(before, tangential(way, before.point.normal), half)) {
    middle->outward = chain[n - 2].outward;
    chain[n - 2] = *middle;
  }
}

/// No spacing along a crease is wider than to the further of the neighbours there: where something
/// stood in the way of a longer step, points inside must stand closer, too.
void CoverPoints::fit_spacings(std::vector<CreasePoint>& chain, bool closed) const {
  constexpr double kShortest = 1.0 / 32;  // of the largest spacing: short creases need no less
  const std::size_t n = chain.size();
  for (std::size_t i = 0; i < n && n > 1; ++i) {
    const auto to = [&](std::size_t k) {
      return distance(chain[i].point.position, chain[k % n].point.position);
    };
    const double before = i > 0 || closed ? to(i + n - 1) : 0;
    const double after = i + 1 < n || closed ? to(i + 1) : 0;
    chain[i].shorten(std::max({before, after, kShortest * spacing_}));
  }
}

void CoverPoints::commit(const std::vector<CreasePoint>& chain, bool closed) {
  constexpr std::uint32_t kNone = ~0u;
  std::uint32_t previous = kNone, first = kNone;
  const auto link = [&](std::uint32_t a, std::uint32_t b) {
    along_crease_[a].push_back(b);
    along_crease_[b].push_back(a);
  };
  for (const CreasePoint& crease : chain) {
    adjoin(chain.front().point, crease.point);
    if (crease.corner) adjoin(crease.point, crease.turn_off_from);
    // Corners are reached from both creases.
    std::uint32_t same = kNone;
    thread_local std::vector<std::uint32_t> ids;
    const double same_place = kSame * crease.spacing.size;
    ids.clear();
    crease_grid_.query(crease.point.position, same_place, 1, ids);
    for (const std::uint32_t id : ids) {
      const CoverPoint& q = points_[id];
      if (distance(q.position, crease.point.position) < same_place &&
          dot(q.normal, crease.point.normal) > walk_.cos_normal_tolerance() &&
          dot(q.inward, normalized(crease.outward)) < -0.5 && on_sheet_of(q, crease.point)) {
        same = id;
      }
    }
    if (same == kNone) {
      const double shallow = length(crease.outward);
      const double inset =
          std::max(kInset * crease.spacing.size, kInsetEpsilons * walk_.rays().epsilon());
      std::optional<ZonePoint> inside;
      for (double depth = inset / shallow; !inside && depth < 40 * inset; depth *= 2) {
        inside =
            walk_.over(crease.point, crease.point.position - normalized(crease.outward) * depth);
      }
      if (!inside) {
        previous = kNone;
        continue;
      }
      adjoin(crease.point, *inside);
      CoverPoint point;
      static_cast<ZonePoint&>(point) = *inside;
      static_cast<PointSpacing&>(point) = crease.spacing;
      point.inward = -tangential(crease.outward, point.normal);
      same = static_cast<std::uint32_t>(points_.size());
      add(point, {crease.spacing});
      if (crease.corner) {
        crease_seeds_.push_back({crease.turn_off_from, crease.turn_off, 0, crease.spacing.longest(),
                                 crease.turn_off_from});
      }
    }
    if (previous != kNone && previous != same) link(previous, same);
    if (first == kNone) first = same;
    previous = same;
  }
  if (closed && previous != kNone && first != previous) link(previous, first);
}

/// Looks for the surfaces that adjoin a crease, by rays from around it, wide and narrow ones.
void CoverPoints::look_across(const CreasePoint& crease) {
  const double size = crease.spacing.size;
  const Vec3 &n = crease.point.normal, m = normalized(crease.outward);
  thread_local std::vector<SurfaceHit> hits;
  for (const double around : {0.05 * size, 0.005 * size, 0.0005 * size}) {
    const Vec3 past = crease.point.position + m * (0.2 * around);
    const auto look = [&](const Vec3& from, const Vec3& direction) {
      walk_.rays().all_hits({from, direction}, {0, 3 * around}, hits);
      for (const SurfaceHit& hit : hits) {
        if (dot(hit.normal, direction) >= 0) continue;
        if (const auto found = walk_.at(hit)) beyond_.push_back(*found);
      }
    };
    look(crease.point.position - m * around + n * around, m);  // a wall
    look(past - n * around + m * around, -m);                  // down over an edge
    look(past + m * around + n * around, -n);                  // a change of zone
    look(past - n * (2 * around), n);                          // the other side
  }
}

void CoverPoints::trace(const CreaseSeed& seed) {
  // Most lead to creases that are traced already, which shows before their course is looked at.
  if (known(seed.last, tangential(seed.direction, seed.last.normal))) return;
  const double size = seed.size, tolerance = fineness(size);
  const double slack = 0.05 * size + 1e-3 * spacing_;
  const double near = std::max(0.0, seed.distance - slack), far = seed.distance + slack;
  if (walk_.step(seed.from, seed.from.position + seed.direction * far)) return;
  const Rim rim = walk_.rim(seed.from, seed.direction, near, far, tolerance);
  adjoin(seed.from, rim.point);
  const Vec3 reached = tangential(seed.direction, rim.point.normal);
  const auto outward = outward_at(rim.point, reached, size);
  if (!outward || known(rim.point, *outward)) return;
  CreasePoint start{rim.point, *outward, {size}};
  start.spacing = spacing_inside(start, size);
  start.spacing.size *= std::max(1.0, kLeastStep * largest_on(rim.point) / start.step());

  std::vector<CreasePoint> chain{start}, back{start};
  bool closed = false;
  const Vec3 left = start.left();
  follow(start, left, chain, closed);
  if (!closed) {
    bool unused = false;
    follow(start, -left, back, unused);
  }
  std::vector<CreasePoint> whole(back.rbegin(), back.rend() - 1);
  whole.insert(whole.end(), chain.begin(), chain.end());
  for (int end = 0; end < 2; ++end) {
    even_out(whole);
    std::reverse(whole.begin(), whole.end());
  }
  look_across(start);
  fit_spacings(whole, closed);
  commit(whole, closed);
}

}  // namespace isolux
