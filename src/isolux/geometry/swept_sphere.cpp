#include "isolux/geometry/swept_sphere.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "isolux/core/error.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {

// Notation (local frame, lengths in units of half the solid's diagonal)
//   o + s d       the line, |d| = 1
//   c(u), r(u)    centre and radius of the ball at u on an arc
//   m(u)          s of the line's point nearest to c(u)
//   H(u)          square of half the chord in that ball: r² − (distance of c from the line)²
// Along the line the ball covers m ± √H. While H stays positive, what the balls cover grows
// together: from the least m − √H to the most m + √H. So the solid's hits are the ends of such
// intervals, once those that overlap are joined. The ends lie where 4 m'² H = H'², at an end of the
// arc, or where a chord begins; as values at an extremum they are sharper than the u that they are
// found at.

namespace {

/// The weights times the coordinates: a combination of an arc's three.
Bernstein<3> along(const Bernstein<3>& x, const Bernstein<3>& y, const Bernstein<3>& z,
                   const Vec3& axis) {
  return x * axis.x + y * axis.y + z * axis.z;
}

}  // namespace

struct SweptSphere::Line {
  Vec3 o, d;
  Frame across;  ///< its third axis is d
};

/// A stretch of the line inside, and the balls at its ends.
struct SweptSphere::Interval {
  struct End {
    double s;
    std::uint32_t arc;
    double u;
  };
  End from, to;
};

SweptSphere::SweptSphere(std::vector<CurvePoint> points, bool loop)
    : points_(std::move(points)), loop_(loop) {
  constexpr std::size_t kMostPoints = 1000;
  const std::size_t n = points_.size(), least = loop ? 3 : 2;
  if (n < least || n > kMostPoints) {
    throw InputError(fmt::format("points: needs {} to {}, not {}", least, kMostPoints, n));
  }
  for (std::size_t i = 0; i < n; ++i) {
    require_point(points_[i].p, fmt::format("points[{}]", i));
    require_length(points_[i].radius, "radius");
    if (i + 1 < n + (loop ? 1 : 0) && points_[i].p == points_[(i + 1) % n].p) {
      throw InputError(
          fmt::format("points: {} and {} are the same; leave one out", i, (i + 1) % n));
    }
  }
  std::vector<CurvePoint> path = points_;
  if (loop) path.push_back(path.front());
  std::vector<CurveArc> curve = loop ? curve_through(path, path[n - 1], path[1])
                                     : curve_through(path, straight_on(path[0], path[1]),
                                                     straight_on(path[n - 1], path[n - 2]));
  for (CurveArc& arc : curve) {
    for (CurvePoint& point : arc) {
      point.radius = std::max(0.0, point.radius);
      const Vec3 half = Vec3{1, 1, 1} * point.radius;
      bounds_.include({point.p - half, point.p + half});
    }
  }
  center_ = bounds_.center();
  unit_ = 0.5 * bounds_.diagonal();
  for (const CurveArc& given : curve) {
    Arc& arc = arcs_.emplace_back();
    Bounds box;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 p = (given[i].p - center_) / unit_;
      arc.x.c[i] = p.x, arc.y.c[i] = p.y, arc.z.c[i] = p.z;
      arc.radius.c[i] = given[i].radius / unit_;
      box.include(p);
    }
    arc.center = box.center();
    arc.reach =
        0.5 * box.diagonal() + *std::max_element(arc.radius.c.begin(), arc.radius.c.end()) + 1e-9;
  }
}

void SweptSphere::find_intervals(const Arc& arc, std::uint32_t index, const Line& line,
                                 std::vector<Interval>& found) {
  const Vec3 &o = line.o, &d = line.d;
  const Frame& across = line.across;
  const Vec3 off = arc.center - o;
  if (length_squared(off - d * dot(off, d)) > arc.reach * arc.reach) return;
  const auto component = [&](const Vec3& axis) {
    return along(arc.x, arc.y, arc.z, axis) + -dot(o, axis);
  };
  const Bernstein<3> m = component(d), a = component(across.u), b = component(across.v);
  const Bernstein<6> H = arc.radius * arc.radius - a * a - b * b;

  std::array<double, 8> ends = {0};
  std::size_t count = 1;
  find_zeros(H, [&](double u) {
    if (count + 1 < ends.size()) ends[count++] = u;
  });
  ends[count++] = 1;
  if (count == 2 && !(H(0.5) > 0)) return;

  // Where the ends of chords may turn: with m' = 0 the two ends turn where H does.
  const Bernstein<2> m_slope = m.derivative();
  const Bernstein<5> H_slope = H.derivative();
  std::array<double, 24> turns;
  std::size_t turn_count = 0;
  const auto add_turn = [&](double u) {
    if (turn_count < turns.size()) turns[turn_count++] = u;
  };
  find_zeros(m_slope * m_slope * H * 4 - H_slope * H_slope, add_turn);
  find_zeros(H_slope, add_turn);
  find_zeros(m_slope, add_turn);

  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (!(H(0.5 * (ends[i] + ends[i + 1])) > 0)) continue;
    Interval interval{{1e9, index, 0}, {-1e9, index, 0}};
    const auto look_at = [&](double u) {
      const double middle = m(u), half = std::sqrt(std::max(0.0, H(u)));
      if (middle - half < interval.from.s) interval.from = {middle - half, index, u};
      if (middle + half > interval.to.s) interval.to = {middle + half, index, u};
    };
    look_at(ends[i]), look_at(ends[i + 1]);
    for (std::size_t k = 0; k < turn_count; ++k) {
      if (turns[k] > ends[i] && turns[k] < ends[i + 1]) look_at(turns[k]);
    }
    found.push_back(interval);
  }
}

void SweptSphere::intersect(const Ray& ray, Hits& hits) const {
  const double speed = length(ray.direction);
  const Vec3 d = ray.direction / speed;
  const double shift = dot(center_ - ray.origin, d);
  const Vec3 o = (ray.origin + d * shift - center_) / unit_;
  if (!(length_squared(o) <= 1.0001)) return;
  const Line line{o, d, Frame(d)};

  thread_local std::vector<Interval> inside;
  inside.clear();
  for (std::uint32_t i = 0; i < arcs_.size(); ++i) find_intervals(arcs_[i], i, line, inside);
  std::sort(inside.begin(), inside.end(),
            [](const Interval& a, const Interval& b) { return a.from.s < b.from.s; });
  const auto add = [&](const Interval::End& end, const Vec3& outward) {
    const Arc& arc = arcs_[end.arc];
    const Vec3 c = arc.at(end.u), away = o + d * end.s - c;
    const double size = length(away);
    const Vec3 normal = size > 0 ? away / size : outward;
    hits.push_back({(shift + end.s * unit_) / speed,
                    center_ + (c + normal * arc.radius(end.u)) * unit_, normal, 0});
  };
  for (std::size_t i = 0; i < inside.size();) {
    Interval whole = inside[i++];
    for (; i < inside.size() && inside[i].from.s <= whole.to.s; ++i) {
      if (inside[i].to.s > whole.to.s) whole.to = inside[i].to;
    }
    add(whole.from, -d);
    add(whole.to, d);
  }
}

/// Whether the point lies in one of the arc's balls.
bool SweptSphere::covers(const Arc& arc, const Vec3& p) const {
  if (length_squared(p - arc.center) > arc.reach * arc.reach) return false;
  const Bernstein<3> x = arc.x + -p.x, y = arc.y + -p.y, z = arc.z + -p.z;
  const Bernstein<6> depth = arc.radius * arc.radius - x * x - y * y - z * z;
  bool covered = depth.c.front() > 0;
  if (!covered) find_zeros(depth, [&](double) { covered = true; });
  return covered;
}

bool SweptSphere::contains(const Vec3& point) const {
  const Vec3 p = (point - center_) / unit_;
  return std::any_of(arcs_.begin(), arcs_.end(), [&](const Arc& arc) { return covers(arc, p); });
}

ShapeDescription SweptSphere::describe() const {
  std::vector<Vec3> points;
  std::vector<double> radii;
  for (const auto& [p, radius] : points_) points.push_back(p), radii.push_back(radius);
  ShapeDescription sweep{"sweep", {{"points", std::move(points)}}, {}, {}};
  if (std::adjacent_find(radii.begin(), radii.end(), std::not_equal_to<>()) == radii.end()) {
    sweep.fields.push_back({"radius", radii.front()});
  } else {
    sweep.fields.push_back({"radii", std::move(radii)});
  }
  if (loop_) sweep.fields.push_back({"loop", true});
  return sweep;
}

}  // namespace isolux
