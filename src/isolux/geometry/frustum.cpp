#include "isolux/geometry/frustum.h"

#include <numbers>

#include "isolux/core/error.h"
#include "isolux/core/vectorize.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

// Notation (in the local frame: start at the origin, end at (0, 0, length))
//   ρ(z) = start_radius + slope z     the radius at height z
//   o + s d, s = t − shift            the line, o near the frustum
//   ρ(o.z) + s ρ'                     the radius along the line, ρ' = slope d.z
// The side is where x² + y² = ρ², one half (nappe) of it where ρ ≥ 0.

namespace {

using std::numbers::pi;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

/// The line in the local frame.
struct Frustum::Line {
  double shift;
  Vec3 o, d;
  double radius, radius_change;  ///< ρ(o.z), ρ'

  /// Those s where the line is within the nappe ρ ≥ 0 of the cone: from first to second, which are
  /// crossings of the cone or infinite. Nothing where it is nowhere.
  std::optional<std::array<double, 2>> inside_cone() const;
};

std::optional<std::array<double, 2>> Frustum::Line::inside_cone() const {
  // a s² + 2 b s + c ≤ 0
  const double a = d.x * d.x + d.y * d.y - radius_change * radius_change;
  const double b = o.x * d.x + o.y * d.y - radius * radius_change;
  const double c = o.x * o.x + o.y * o.y - radius * radius;
  if (a == 0 && b == 0) {
    if (!(c < 0)) return std::nullopt;
    return std::array{-kInfinity, kInfinity};
  }
  if (a == 0) {
    const double s = -c / (2 * b);
    return b < 0 ? std::array{s, kInfinity} : std::array{-kInfinity, s};
  }
  // b² − a c by Lagrange's identity, which does not cancel where o is far out.
  const double mx = o.x * radius_change - radius * d.x, my = o.y * radius_change - radius * d.y;
  const double turn = o.x * d.y - o.y * d.x;
  const double discriminant = mx * mx + my * my - turn * turn;
  if (a > 0 && !(discriminant > 0)) return std::nullopt;
  const double root = std::sqrt(std::max(0.0, discriminant));
  const double q = -(b + std::copysign(root, b));
  const double s1 = q / a, s2 = q != 0 ? c / q : s1;
  const double low = std::min(s1, s2), high = std::max(s1, s2);
  if (a > 0) return std::array{low, high};
  return radius_change > 0 ? std::array{high, kInfinity} : std::array{-kInfinity, low};
}

/// At most two crossings, in ascending order.
struct Frustum::Crossings {
  std::array<Crossing, 2> items;
  int count = 0;

  void add(double t, std::uint32_t face) { items[count++] = {t, face}; }
  const Crossing* begin() const { return items.data(); }
  const Crossing* end() const { return items.data() + count; }
};

Frustum::Frustum(const Vec3& start, const Vec3& end, double start_radius, double end_radius,
                 bool capped)
    : start_(start),
      end_(end),
      frame_(normalized(end - start)),
      length_(distance(start, end)),
      start_radius_(start_radius),
      end_radius_(end_radius),
      slope_((end_radius - start_radius) / length_),
      capped_(capped) {
  require_point(start, "start");
  require_point(end, "end");
  require_length_or_zero(start_radius, "start_radius");
  require_length_or_zero(end_radius, "end_radius");
  if (start_radius == 0 && end_radius == 0) {
    throw InputError("start_radius and end_radius: one must be greater than 0");
  }
  if (length_ < kShortestLength) {
    throw InputError("start and end: must be two different points");
  }
}

Bounds Frustum::bounds() const {
  Bounds box;
  const Vec3 end = start_ + frame_.n * length_;
  const Vec3 at_start = circle_extent(frame_.n, start_radius_);
  const Vec3 at_end = circle_extent(frame_.n, end_radius_);
  for (const Vec3& p : {start_ - at_start, start_ + at_start, end - at_end, end + at_end}) {
    box.include(p);
  }
  return box;
}

Frustum::Line Frustum::localize(const Ray& ray) const {
  const auto to_local = [this](const Vec3& v) {
    return Vec3{dot(v, frame_.u), dot(v, frame_.v), dot(v, frame_.n)};
  };
  const Vec3 middle = start_ + frame_.n * (0.5 * length_);
  Line line;
  line.shift = dot(middle - ray.origin, ray.direction) / length_squared(ray.direction);
  line.o = to_local(ray.at(line.shift) - start_);
  line.d = to_local(ray.direction);
  line.radius = start_radius_ + slope_ * line.o.z;
  line.radius_change = slope_ * line.d.z;
  return line;
}

Frustum::Crossings Frustum::crossings(const Line& line) const {
  Crossings found;
  const auto cone = line.inside_cone();
  if (!cone) return found;
  Crossing enter{(*cone)[0], 0}, leave{(*cone)[1], 0};
  if (!capped_) {
    for (const Crossing& c : {enter, leave}) {
      const double z = line.o.z + c.t * line.d.z;
      if (std::isfinite(c.t) && z >= 0 && z <= length_) found.add(c.t, 0);
    }
    return found;
  }
  if (line.d.z == 0) {
    if (!(line.o.z > 0 && line.o.z < length_)) return found;
  } else {
    Crossing low{-line.o.z / line.d.z, 1}, high{(length_ - line.o.z) / line.d.z, 2};
    if (line.d.z < 0) std::swap(low, high);
    if (low.t >= enter.t) enter = low;
    if (high.t <= leave.t) leave = high;
  }
  if (!(enter.t < leave.t) || !std::isfinite(leave.t - enter.t)) return found;
  found.add(enter.t, enter.face);
  found.add(leave.t, leave.face);
  return found;
}

Hit Frustum::hit(const Line& line, const Crossing& crossing) const {
  const Vec3 p = line.o + line.d * crossing.t;
  const double t = line.shift + crossing.t;
  if (crossing.face != 0) {
    const bool at_end = crossing.face == 2;
    const Vec3 point = start_ + frame_.to_world({p.x, p.y, at_end ? length_ : 0});
    return {t, point, at_end ? frame_.n : -frame_.n, crossing.face};
  }
  const double z = std::clamp(p.z, 0.0, length_);
  const double r = std::sqrt(p.x * p.x + p.y * p.y), radius = start_radius_ + slope_ * z;
  if (!(r > 0)) {  // the tip of a cone has no normal: take the axis
    return {t, start_ + frame_.n * z, slope_ > 0 ? -frame_.n : frame_.n, 0};
  }
  const Vec3 outward{p.x / r, p.y / r, 0};
  const Vec3 normal = normalized(frame_.to_world({outward.x, outward.y, -slope_}));
  return {t, start_ + frame_.to_world({outward.x * radius, outward.y * radius, z}), normal, 0};
}

void Frustum::intersect(const Ray& ray, Hits& hits) const {
  if (surely_missed_by(ray)) return;
  const Line line = localize(ray);
  for (const Crossing& c : crossings(line)) hits.push_back(hit(line, c));
}

bool Frustum::occludes(const Ray& ray, double t_min, double t_max) const {
  if (surely_missed_by(ray)) return false;
  const Line line = localize(ray);
  for (const Crossing& c : crossings(line)) {
    const double t = c.t + line.shift;
    if (t > t_min && t < t_max) return true;
  }
  return false;
}

/// occludes() for many lines at once: localize(), inside_cone() and crossings() without branches.
/// Lines that cross one nappe alone, or are parallel to the side or the caps, are left to the
/// caller: `one_by_one`.
ISOLUX_VECTORIZE
void Frustum::occlude_regular(const Frustum& frustum, const SegmentBlock& segments, double t_max,
                              SegmentBlock::Mask& blocked, SegmentBlock::Mask& one_by_one) {
  one_by_one = {};
  std::int64_t reached = 0;
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
    reached |= !frustum.surely_missed_by(segments.ray(i));
  }
  if (reached == 0) return;
  const Vec3 start = frustum.start_, u = frustum.frame_.u, v = frustum.frame_.v,
             n = frustum.frame_.n;
  const Vec3 middle = start + n * (0.5 * frustum.length_);
  const double slope = frustum.slope_, start_radius = frustum.start_radius_, top = frustum.length_;
  const bool capped = frustum.capped_;
  const double open = capped ? 0 : kInfinity;  // how far beyond its ends nothing is cut off
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
    const Ray ray = segments.ray(i);
    const double shift = dot(middle - ray.origin, ray.direction) / length_squared(ray.direction);
    const Vec3 near = ray.at(shift) - start;
    const Vec3 o{dot(near, u), dot(near, v), dot(near, n)};
    const Vec3 d{dot(ray.direction, u), dot(ray.direction, v), dot(ray.direction, n)};
    const double radius = start_radius + slope * o.z, radius_change = slope * d.z;

    const double a = d.x * d.x + d.y * d.y - radius_change * radius_change;
    const double b = o.x * d.x + o.y * d.y - radius * radius_change;
    const double c = o.x * o.x + o.y * o.y - radius * radius;
    const double mx = o.x * radius_change - radius * d.x, my = o.y * radius_change - radius * d.y;
    const double turn = o.x * d.y - o.y * d.x;
    const double discriminant = mx * mx + my * my - turn * turn;
    // Not a number where the line misses the cone, so that nothing below holds.
    const double root = std::sqrt(discriminant);
    const double q = -(b + std::copysign(root, b));
    const double s1 = q / a, s2 = c / q;
    const double at_start = -o.z / d.z, at_end = (top - o.z) / d.z;
    const double low = std::min(s1, s2), high = std::max(s1, s2);
    const double enter = std::max(low, std::min(at_start, at_end) - open);
    const double leave = std::min(high, std::max(at_start, at_end) + open);
    const double first = enter + shift, last = leave + shift;
    const double first_z = o.z + enter * d.z, last_z = o.z + leave * d.z;
    const bool first_there = capped | ((first_z >= 0) & (first_z <= top));
    const bool last_there = capped | ((last_z >= 0) & (last_z <= top));
    const bool regular = (a > 0) & ((d.z != 0) | !capped);
    blocked[i] |= regular & (root > 0) & (!capped | (enter < leave)) &
                  ((first_there & (first > 0) & (first < t_max)) |
                   (last_there & (last > 0) & (last < t_max)));
    one_by_one[i] = regular ? 0 : 1;
  }
}

void Frustum::occlude(const SegmentBlock& segments, double t_max,
                      SegmentBlock::Mask& blocked) const {
  SegmentBlock::Mask one_by_one;
  occlude_regular(*this, segments, t_max, blocked, one_by_one);
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
    if (one_by_one[i]) blocked[i] |= occludes(segments.ray(i), 0, t_max);
  }
}

bool Frustum::contains(const Vec3& point) const {
  if (!capped_) return false;
  const Vec3 p = point - start_;
  const double z = dot(p, frame_.n), x = dot(p, frame_.u), y = dot(p, frame_.v);
  const double radius = start_radius_ + slope_ * z;
  return z > 0 && z < length_ && x * x + y * y < radius * radius;
}

std::optional<double> Frustum::area() const {
  const double slant = std::hypot(length_, end_radius_ - start_radius_);
  const double caps = start_radius_ * start_radius_ + end_radius_ * end_radius_;
  return pi * ((start_radius_ + end_radius_) * slant + (capped_ ? caps : 0));
}

TriangleSoup Frustum::side_triangles(double segments, double max_edge) const {
  // n flat trapezoids of radius scaled by √w have the area of the cone's side where
  // w (length² + c² Δr² w) = k, c = cos(π/n).
  const double change = end_radius_ - start_radius_, ll = length_ * length_;
  const double chord = (pi / segments) / std::sin(pi / segments);
  const double k = chord * chord * (ll + change * change);
  const double c = std::cos(pi / segments) * change;
  const double scale = std::sqrt(2 * k / (ll + std::sqrt(ll * ll + 4 * c * c * k)));
  return grid(
      segments, piece_count(std::hypot(length_, change), max_edge), true, [&](double u, double v) {
        const double r = scale * (start_radius_ + v * change), angle = 2 * pi * u;
        return start_ + frame_.to_world({r * std::cos(angle), r * std::sin(angle), v * length_});
      });
}

std::optional<TriangleSoup> Frustum::triangulate(double max_edge) const {
  const double segments = circle_segments(std::max(start_radius_, end_radius_), max_edge);
  TriangleSoup soup = side_triangles(segments, max_edge);
  if (!capped_) return soup;
  const Vec3 end = start_ + frame_.n * length_;
  if (start_radius_ > 0) {
    append(soup, disk_triangles(start_, -frame_.n, start_radius_, 0, segments, max_edge));
  }
  if (end_radius_ > 0) {
    append(soup, disk_triangles(end, frame_.n, end_radius_, 0, segments, max_edge));
  }
  return soup;
}

ShapeDescription Frustum::describe() const {
  ShapeDescription frustum{"cone", {{"from", start_}, {"to", end_}}, {}, {}};
  if (start_radius_ == end_radius_) {
    frustum.kind = "cylinder";
    frustum.fields.push_back({"radius", start_radius_});
  } else {
    frustum.fields.push_back({"radii", std::vector{start_radius_, end_radius_}});
  }
  if (!capped_) frustum.fields.push_back({"open", true});
  return frustum;
}

}  // namespace isolux
