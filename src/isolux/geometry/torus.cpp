#include "isolux/geometry/torus.h"

#include <fmt/format.h>

#include <numbers>

#include "isolux/core/error.h"
#include "isolux/geometry/bracketed_root.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {

// Notation (local frame, lengths in units of R + r)
//   R, r        major and minor radius
//   o + s d     the line, o its point nearest to the centre, |d| = 1
//   q(s)        = (|p|² + R² − r²)² − 4 R² (x² + y²), p = o + s d: s⁴ + c2 s² + c1 s + c0
//   g(p)        = (√(x² + y²) − R)² + z² − r²: same zeros as q, better conditioned for thin tori
// Between two neighbouring zeros of q' the quartic is monotonic, so that a change of sign brackets
// exactly one root, and the roots come in pairs of entering and leaving.

namespace {

/// The ends of the intervals on which s⁴ + c2 s² + c1 s + c0 is monotonic within [−end, end].
struct Pieces {
  std::array<double, 5> ends;
  int count = 0;

  Pieces(double c2, double c1, double end) {
    const auto derivative = [=](double s) {
      return ValueAndSlope{(4 * s * s + 2 * c2) * s + c1, 12 * s * s + 2 * c2};
    };
    const double turn = c2 < 0 ? std::min(end, std::sqrt(-c2 / 6)) : 0;
    add(-end);
    const std::array<double, 4> steps = {-end, -turn, turn, end};
    for (int i = 0; i < 3; ++i) {
      const double a = steps[i], b = steps[i + 1];
      const bool rising = derivative(a).value < 0;
      if (a < b && rising != (derivative(b).value < 0)) {
        add(bracketed_root(derivative, a, b, rising));
      }
    }
    add(end);
  }
  void add(double s) { ends[count++] = s; }
};

}  // namespace

Torus::Torus(const Vec3& center, const Vec3& axis, double major, double minor)
    : center_(center), frame_(unit_vector(axis)), major_(major), minor_(minor) {
  require_point(center, "center");
  require_direction(axis, "axis");
  require_length(major, "major_radius");
  require_length(minor, "minor_radius");
  if (!(minor < major)) {
    throw InputError(fmt::format(
        "minor_radius: must be less than major_radius, lest the torus cut itself, but {} >= {}",
        minor, major));
  }
}

Bounds Torus::bounds() const {
  const Vec3 half = circle_extent(frame_.n, major_) + Vec3{1, 1, 1} * minor_;
  return {center_ - half, center_ + half};
}

/// Whether the line may meet the surface between s = a and b: it passes neither above nor below,
/// nor outside, nor through the hole.
bool Torus::may_meet(const LocalLine& line, double a, double b) const {
  constexpr double kHair = 1e-9;
  const double unit = major_ + minor_;
  const double R = major_ / unit, r = minor_ / unit * (1 + kHair);
  const auto& [o, d, shift, speed] = line;
  const double reach = 1 - length_squared(o);
  if (!(reach > 0)) return false;  // passes the sphere around the torus
  const double half = std::sqrt(reach) + kHair;
  a = std::max(a, -half), b = std::min(b, half);
  if (d.z != 0) {
    const double at_bottom = (-r - o.z) / d.z, at_top = (r - o.z) / d.z;
    a = std::max(a, std::min(at_bottom, at_top)), b = std::min(b, std::max(at_bottom, at_top));
  } else if (std::abs(o.z) > r) {
    return false;
  }
  if (!(a <= b)) return false;
  // The square of the distance from the axis, convex along the line.
  const double q2 = d.x * d.x + d.y * d.y, q1 = o.x * d.x + o.y * d.y, q0 = o.x * o.x + o.y * o.y;
  const auto squared = [&](double s) { return (q2 * s + 2 * q1) * s + q0; };
  const double nearest = q2 > 0 ? std::clamp(-q1 / q2, a, b) : a;
  const double inner = (R - r) * (1 - kHair), outer = (R + r) * (1 + kHair);
  return squared(nearest) <= outer * outer && std::max(squared(a), squared(b)) >= inner * inner;
}

Torus::LocalLine Torus::localize(const Ray& ray) const {
  const double unit = major_ + minor_, speed = length(ray.direction);
  const Vec3 direction = ray.direction / speed;
  const double shift = dot(center_ - ray.origin, direction);
  const auto to_local = [this](const Vec3& v) {
    return Vec3{dot(v, frame_.u), dot(v, frame_.v), dot(v, frame_.n)};
  };
  return {to_local(ray.origin + direction * shift - center_) / unit, to_local(direction), shift,
          speed};
}

bool Torus::occludes(const Ray& ray, double t_min, double t_max) const {
  const LocalLine line = localize(ray);
  const double unit = major_ + minor_;
  const auto s = [&](double t) { return (t * line.speed - line.shift) / unit; };
  return may_meet(line, s(t_min), s(t_max)) && Shape::occludes(ray, t_min, t_max);
}

void Torus::intersect(const Ray& ray, Hits& hits) const {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  const LocalLine line = localize(ray);
  if (!may_meet(line, -kAll, kAll)) return;
  const Vec3 &o = line.o, &d = line.d;
  const double unit = major_ + minor_;
  const double R = major_ / unit, r = minor_ / unit;
  const double oo = length_squared(o);
  const double k = oo + R * R - r * r;
  const double c2 = 2 * k - 4 * R * R * (d.x * d.x + d.y * d.y);
  const double c1 = -8 * R * R * (o.x * d.x + o.y * d.y);
  const auto g = [&](double s) {
    const Vec3 p = o + d * s;
    const double ring = std::sqrt(p.x * p.x + p.y * p.y);
    const double away = ring - R;
    const double ring_slope = ring > 0 ? (p.x * d.x + p.y * d.y) / ring : 0;
    return ValueAndSlope{away * away + (p.z - r) * (p.z + r), 2 * (away * ring_slope + p.z * d.z)};
  };
  const Pieces pieces(c2, c1, 1.0000001);
  for (int i = 0; i + 1 < pieces.count; ++i) {
    const double a = pieces.ends[i], b = pieces.ends[i + 1];
    const bool rising = g(a).value < 0;
    if (rising == (g(b).value < 0)) continue;
    const double s = bracketed_root(g, a, b, rising);
    const Vec3 p = o + d * s;
    const double ring = std::hypot(p.x, p.y);
    const Vec3 on_circle = Vec3{p.x, p.y, 0} * (R / ring);
    const Vec3 normal = frame_.to_world(normalized(p - on_circle));
    const Vec3 point = center_ + frame_.to_world(on_circle * unit) + normal * minor_;
    hits.push_back({(line.shift + s * unit) / line.speed, point, normal, 0});
  }
}

bool Torus::contains(const Vec3& point) const {
  const Vec3 p = point - center_;
  const double away = std::hypot(dot(p, frame_.u), dot(p, frame_.v)) - major_;
  return std::hypot(away, dot(p, frame_.n)) < minor_;
}

std::optional<double> Torus::area() const {
  return 4 * std::numbers::pi * std::numbers::pi * major_ * minor_;
}

ShapeDescription Torus::describe() const {
  return {
      "torus",
      {{"center", center_}, {"axis", frame_.n}, {"major_radius", major_}, {"minor_radius", minor_}},
      {},
      {}};
}

}  // namespace isolux
