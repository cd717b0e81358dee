#include "isolux/geometry/prism.h"

#include <fmt/format.h>

#include <numbers>

#include "isolux/core/error.h"
#include "isolux/geometry/monotonic_search.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

// Notation (local frame: lengths in the plane in units of the base's size, z = 0 the base, z = 1
// the top, the axis of turning and scaling along z)
//   S(z), R(z)  scaling by scale_at(z), turning by twist z
//   q           the place on the base that went to p = (S R q, z)
//   n, c        normal of a side of the base and the distance of its line: n·q = c there
// With k = S's factors, a point is on the surface of that side where
//   f(p) = (R n)·(k_y p_x, k_x p_y) − c k_x k_y = 0,
// which for equal factors is (R n)·(p_x, p_y) − c k times k. Along a line f is linear where all is
// flat, a quadratic for unequal factors, and not algebraic with a twist.

namespace {

constexpr double kSlack = 1e-12;  ///< local lengths that count as none

Vec3 turned(const Vec3& v, double radians) {
  const double c = std::cos(radians), s = std::sin(radians);
  return {c * v.x - s * v.y, s * v.x + c * v.y, 0};
}

/// The polynomial c[0] + c[1] s + c[2] s².
struct Quadratic {
  std::array<double, 3> c = {};

  double at(double s) const { return (c[2] * s + c[1]) * s + c[0]; }
  double slope(double s) const { return 2 * c[2] * s + c[1]; }
  /// The most that it, its slope, come to on [a, b], in absolute value.
  double most(double a, double b) const {
    const double m = 0.5 * (a + b), h = 0.5 * (b - a);
    return std::abs(at(m)) + std::abs(slope(m)) * h + std::abs(c[2]) * h * h;
  }
  double most_slope(double a, double b) const {
    return std::max(std::abs(slope(a)), std::abs(slope(b)));
  }
};

using Linear = std::array<double, 2>;

Quadratic operator*(const Linear& a, const Linear& b) {
  return {{a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[1] * b[1]}};
}

/// Calls found(s) for the real zeros.
template <typename Found>
void solve(const Quadratic& f, const Found& found) {
  const auto [c, b, a] = f.c;
  const double discriminant = b * b - 4 * a * c;
  if (!(discriminant >= 0)) return;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0) return;
  found(c / q);
  if (a != 0) found(q / a);
}

}  // namespace

/// The line o + s d in the local frame, |d| = 1; t = shift + s / speed.
struct Prism::Line {
  Vec3 o, d;
  double shift, speed;

  Vec3 at(double s) const { return o + d * s; }
};

Prism::Prism(const std::vector<Vec3>& outline, const std::vector<std::vector<Vec3>>& holes,
             const Vec3& along, const std::optional<PrismTop>& top)
    : outline_(outline), holes_(holes), top_(top), along_(along), region_(outline, holes) {
  require_direction(along, "along");
  const double height = std::abs(dot(along, region_.frame.n));
  if (!(height > 1e-6 * length(along)) || height < kShortestLength) {
    throw InputError("along: must lead out of the plane of the points");
  }
  Frame frame = region_.frame;
  const bool upward = dot(along, frame.n) > 0;
  if (!upward) frame = Frame(-frame.n);
  Vec3 center = region_.center;
  if (top) {
    require_point(top->center, "center");
    for (const double factor : top->scale) {
      if (factor >= 0 && factor <= 1e6) continue;
      throw InputError(fmt::format("scale: must be from 0 to 1e6, not {}", factor));
    }
    if (!(std::abs(top->twist) <= 3600)) {
      throw InputError(fmt::format("twist: must be within 3600 degrees, not {}", top->twist));
    }
    center = top->center - along * (dot(top->center - center, frame.n) / dot(along, frame.n));
    top_scale_ = {top->scale[0], top->scale[1], 0};
    twist_ = top->twist * (std::numbers::pi / 180);
  }
  double unit = 0;
  for (const Vec3& p : region_.soup.points) unit = std::max(unit, distance(p, center));
  const Vec3 u = frame.u * unit, v = frame.v * unit;
  to_world_ = {{Vec3{u.x, v.x, along.x}, {u.y, v.y, along.y}, {u.z, v.z, along.z}}, center};
  const auto inverse = to_world_.inverse();
  if (!inverse) throw InputError("along: the prism is too thin to be told from a plane");
  to_local_ = *inverse;

  for (const Vec3& p : region_.soup.points) {
    const Vec3 local = to_local_.point(p);
    corners_.push_back({local.x, local.y, 0});
  }
  for (const Ring& ring : region_.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Vec3 from = corners_[ring[i]], to = corners_[ring[(i + 1) % ring.size()]];
      if (!upward) std::swap(from, to);
      const Vec3 way = to - from;
      const double size = length(way);
      const Vec3 normal = Vec3{way.y, -way.x, 0} / size;
      sides_.push_back({from, to, normal, size, dot(normal, from)});
    }
  }
  if (twist_ == 0) {
    for (const Vec3& q : corners_) {
      local_bounds_.include(q);
      local_bounds_.include(from_base(q, 1));
    }
  } else {
    const Vec3 reach = max(Vec3{1, 1, 0}, top_scale_);
    local_bounds_ = {-reach, reach + Vec3{0, 0, 1}};
  }
}

Bounds Prism::bounds() const {
  Bounds box;
  if (twist_ == 0) {
    for (const Vec3& q : corners_) {
      box.include(to_world_.point(q));
      box.include(to_world_.point(from_base(q, 1)));
    }
    return box;
  }
  const auto& [lower, upper] = local_bounds_;
  for (int i = 0; i < 8; ++i) {
    box.include(to_world_.point(
        {i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z}));
  }
  return box;
}

/// Where on the base the point came from; not finite at the height where the outline has shrunk to
/// a point.
Vec3 Prism::to_base(const Vec3& p) const {
  const Vec3 k = scale_at(p.z);
  const Vec3 q{p.x / k.x, p.y / k.y, 0};
  return twist_ == 0 ? q : turned(q, -twist_ * p.z);
}

Vec3 Prism::from_base(const Vec3& q, double z) const {
  const Vec3 k = scale_at(z), r = twist_ == 0 ? q : turned(q, twist_ * z);
  return {k.x * r.x, k.y * r.y, z};
}

bool Prism::contains_local(const Vec3& p) const {
  return p.z > 0 && p.z < 1 && encloses(corners_, region_.rings, to_base(p));
}

bool Prism::contains(const Vec3& point) const { return contains_local(to_local_.point(point)); }

/// Adds where the line may cross a side between s = a and b.
void Prism::find_sides(const Line& line, double a, double b, std::vector<Candidate>& found) const {
  const Vec3 &o = line.o, &d = line.d;
  const Vec3 k0 = scale_at(o.z), k1 = (top_scale_ - Vec3{1, 1, 0}) * d.z;
  const Linear kx = {k0.x, k1.x}, ky = {k0.y, k1.y};
  const bool equal = top_scale_.x == top_scale_.y;
  // With equal factors one of them cancels out.
  const Linear one = {1, 0};
  const Quadratic ux = Linear{o.x, d.x} * (equal ? one : ky);
  const Quadratic uy = Linear{o.y, d.y} * (equal ? one : kx);
  const Quadratic kk = kx * (equal ? one : ky);
  const double turn = twist_ * d.z;
  std::uint32_t face = 2;
  for (const Side& side : sides_) {
    const auto add = [&](double s) {
      if (!(s >= a && s <= b)) return;
      const double place = dot(to_base(line.at(s)) - side.from, side.to - side.from) / side.length;
      if (place >= -kSlack && place <= side.length + kSlack) found.push_back({s, face});
    };
    const Vec3& n = side.normal;
    if (turn == 0) {
      const Vec3 m = twist_ == 0 ? n : turned(n, twist_ * o.z);
      Quadratic f;
      for (std::size_t i = 0; i < 3; ++i) {
        f.c[i] = m.x * ux.c[i] + m.y * uy.c[i] - side.away * kk.c[i];
      }
      solve(f, add);
    } else {
      const auto f = [&](double s) {
        const Vec3 m = turned(n, twist_ * (o.z + s * d.z));
        const double x = ux.at(s), y = uy.at(s);
        return ValueAndSlope{m.x * x + m.y * y - side.away * kk.at(s),
                             turn * (m.x * y - m.y * x) + m.x * ux.slope(s) + m.y * uy.slope(s) -
                                 side.away * kk.slope(s)};
      };
      const double most = std::hypot(ux.most(a, b), uy.most(a, b));
      const double slope = std::hypot(ux.most_slope(a, b), uy.most_slope(a, b));
      const double bend = 2 * std::hypot(ux.c[2], uy.c[2]);
      const double curvature = turn * turn * most + 2 * std::abs(turn) * slope + bend +
                               std::abs(side.away) * 2 * std::abs(kk.c[2]);
      find_sign_changes(f, curvature, a, b, add);
    }
    ++face;
  }
}

Hit Prism::hit(const Line& line, const Candidate& candidate) const {
  const auto world_normal = [&](const Vec3& v) { return normalized(to_local_.transposed(v)); };
  const double t = line.shift + candidate.s / line.speed;
  Vec3 p = line.at(candidate.s);
  if (candidate.face < 2) {
    p.z = candidate.face;
    const Vec3 up = world_normal({0, 0, 1});
    return {t, to_world_.point(p), candidate.face == 0 ? -up : up, candidate.face};
  }
  // Newton's steps along the normal put the point onto the surface.
  const Side& side = sides_[candidate.face - 2];
  const Vec3 change = top_scale_ - Vec3{1, 1, 0};
  const bool equal = top_scale_.x == top_scale_.y;
  Vec3 point = to_world_.point(p), gradient;
  for (int i = 0; i < 2; ++i) {
    const Vec3 k = scale_at(p.z), m = turned(side.normal, twist_ * p.z);
    const double kx = equal ? 1 : k.x, ky = equal ? 1 : k.y;
    const double dx = equal ? 0 : change.x, dy = equal ? 0 : change.y;
    const double f = m.x * ky * p.x + m.y * kx * p.y - side.away * k.x * ky;
    const Vec3 slope{m.x * ky, m.y * kx,
                     twist_ * (m.x * kx * p.y - m.y * ky * p.x) + m.x * dy * p.x + m.y * dx * p.y -
                         side.away * (change.x * ky + k.x * dy)};
    gradient = to_local_.transposed(slope);
    point -= gradient * (f / length_squared(gradient));
    p = to_local_.point(point);
  }
  return {t, point, normalized(gradient), candidate.face};
}

void Prism::intersect(const Ray& ray, Hits& hits) const {
  Line line;
  const Vec3 middle = to_world_.point({0, 0, 0.5});
  line.shift = dot(middle - ray.origin, ray.direction) / length_squared(ray.direction);
  const Vec3 direction = to_local_.vector(ray.direction);
  line.speed = length(direction);
  line.o = to_local_.point(ray.at(line.shift));
  line.d = direction / line.speed;
  double a = -std::numeric_limits<double>::infinity(), b = -a;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = line.o[axis], d = line.d[axis];
    const double lower = local_bounds_.lower[axis] - 1e-9, upper = local_bounds_.upper[axis] + 1e-9;
    if (d == 0 ? o < lower || o > upper : !std::isfinite(o / d)) return;
    if (d == 0) continue;
    a = std::max(a, std::min((lower - o) / d, (upper - o) / d));
    b = std::min(b, std::max((lower - o) / d, (upper - o) / d));
  }
  if (!(a <= b) || !std::isfinite(a) || !std::isfinite(b)) return;

  thread_local std::vector<Candidate> candidates;
  candidates.clear();
  if (line.d.z != 0) {
    candidates.push_back({-line.o.z / line.d.z, 0});
    candidates.push_back({(1 - line.o.z) / line.d.z, 1});
  }
  find_sides(line, a, b, candidates);
  append_crossings(
      candidates, ray.direction, [&](double s) { return contains_local(line.at(s)); },
      [&](const Candidate& c, bool /*entering*/) { return hit(line, c); }, hits);
}

std::optional<double> Prism::area() const {
  if (!flat()) return std::nullopt;
  const auto soup = triangulate(std::numeric_limits<double>::infinity());
  return isolux::area(*soup);
}

std::optional<TriangleSoup> Prism::triangulate(double max_edge) const {
  if (!flat()) return std::nullopt;
  TriangleSoup all;
  const bool upward = dot(along_, region_.frame.n) > 0;
  for (const double z : {0.0, 1.0}) {
    if (z == 1 && top_scale_.x == 0) continue;
    TriangleSoup cap{{}, region_.soup.triangles};
    for (const Vec3& q : corners_) cap.points.push_back(to_world_.point(from_base(q, z)));
    if (upward == (z == 0)) flip(cap);
    append(all, cap);
  }
  for (const Side& side : sides_) {
    TriangleSoup quad;
    for (const Vec3& p : {from_base(side.from, 0), from_base(side.to, 0), from_base(side.to, 1),
                          from_base(side.from, 1)}) {
      quad.points.push_back(to_world_.point(p));
    }
    quad.triangles.push_back({0, 1, 2});
    if (top_scale_.x > 0) quad.triangles.push_back({0, 2, 3});
    append(all, quad);
  }
  subdivide(all, max_edge);
  return all;
}

ShapeDescription Prism::describe() const {
  ShapeDescription prism{"prism", {{"points", outline_}}, {}, {}};
  if (!holes_.empty()) prism.fields.push_back({"holes", holes_});
  prism.fields.push_back({"along", along_});
  if (!top_) return prism;
  prism.fields.push_back({"center", top_->center});
  if (top_->scale[0] == top_->scale[1]) {
    if (top_->scale[0] != 1) prism.fields.push_back({"scale", top_->scale[0]});
  } else {
    prism.fields.push_back({"scale", std::vector{top_->scale[0], top_->scale[1]}});
  }
  if (top_->twist != 0) prism.fields.push_back({"twist", top_->twist});
  return prism;
}

}  // namespace isolux
