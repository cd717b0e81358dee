#include "isolux/geometry/revolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "isolux/core/error.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/planar_region.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

// Notation (local frame: the axis is z, lengths in units of the solid's size)
//   o + s d       the line, |d| = 1; ρ(s) its distance from the axis
//   (r, z)(u)     a part of the profile, 0 ≤ u ≤ 1
//   nr, nz, away  normal and place of a straight part: nr ρ + nz z = away on it
// A line meets a straight part where (nr ρ)² = (away − nz z)², a quadratic in s. It meets a curved
// one where r(u)² = ρ(s)² at z(u) = o.z + s d.z; with s eliminated that is of degree 6 in u.

namespace {

using std::numbers::pi;
constexpr double kSlack = 1e-12;  ///< local lengths that count as none

}  // namespace

struct Revolution::Line {
  Vec3 o, d;
  double shift, speed;  ///< t = shift + s / speed

  Vec3 at(double s) const { return o + d * s; }
};

Revolution::Revolution(const Vec3& center, const Vec3& axis, std::vector<ProfilePoint> profile,
                       const RevolutionForm& form)
    : given_center_(center),
      axis_(axis),
      profile_(std::move(profile)),
      form_(form),
      frame_(unit_vector(axis)) {
  require_point(center, "center");
  require_direction(axis, "axis");
  if (!(form.angle > 0 && form.angle <= 360)) {
    throw InputError(
        fmt::format("angle: must be more than 0 and at most 360 degrees, not {}", form.angle));
  }
  angle_ = form.angle * (pi / 180);
  constexpr std::size_t kMostPoints = 1000;
  if (profile_.size() > kMostPoints) {
    throw InputError(
        fmt::format("profile: has at most {} points, not {}", kMostPoints, profile_.size()));
  }
  Bounds flat;
  std::vector<Vec3> outline;
  for (const auto& [r, z] : profile_) {
    require_length_or_zero(r, "profile");
    require_point({r, 0, z}, "profile");
    outline.push_back({r, 0, z});
    flat.include(outline.back());
  }
  if (flat.empty()) throw InputError("profile: needs at least two points");
  const double middle = flat.center().z;
  unit_ = std::max(flat.upper.x, flat.upper.z - middle);
  require_length(unit_, "profile");
  center_ = center + frame_.n * middle;
  std::vector<ProfilePoint> local;
  for (const auto& [r, z] : profile_) local.push_back({r / unit_, (z - middle) / unit_});
  parts_ = profile_parts(local, form.smooth, form.open);
  if (!form.open && !form.smooth) {
    const PlanarRegion region(outline, {});  // refuses what crosses itself
    cut_.triangles = region.soup.triangles;
    for (const auto& [r, z] : local) cut_.points.push_back({r, 0, z});
    if (region.frame.n.y > 0) flip(cut_);
  }
  for (const ProfilePart& part : parts_) {
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 on_axis = center_ + frame_.n * (part.z.c[i] * unit_);
      const Vec3 reach = circle_extent(frame_.n, part.r.c[i] * unit_);
      bounds_.include({on_axis - reach, on_axis + reach});
    }
  }
}

bool Revolution::within_angle(const Vec3& p) const {
  if (form_.angle == 360) return true;
  const double azimuth = std::atan2(p.y, p.x);
  return (azimuth < 0 ? azimuth + 2 * pi : azimuth) <= angle_;
}

bool Revolution::inside(const Vec3& p) const {
  return within_angle(p) && encloses(parts_, std::hypot(p.x, p.y), p.z);
}

bool Revolution::contains(const Vec3& point) const {
  return solid() && inside(to_local(point - center_) / unit_);
}

void Revolution::find_straight(std::uint32_t index, const Line& line,
                               std::vector<Candidate>& found) const {
  const ProfilePart& part = parts_[index];
  const auto& [o, d, shift, speed] = line;
  const auto add = [&](double s) {
    if (!std::isfinite(s)) return;
    const Vec3 p = line.at(s);
    const double rho = std::hypot(p.x, p.y);
    if (std::abs(part.nr * rho + part.nz * p.z - part.away) > 1e-6) return;  // the other nappe
    const double place = part.nr * (p.z - part.z.c[0]) - part.nz * (rho - part.r.c[0]);
    const double slack = form_.open ? 0 : kSlack;
    if (place >= -slack && place <= part.length + slack) found.push_back({s, index});
  };
  if (part.nr == 0) return add((part.z.c[0] - o.z) / d.z);
  // a s² + 2 b s + c = 0, the discriminant by Lagrange's identity
  const double w0 = part.away - part.nz * o.z, w1 = -part.nz * d.z;
  const double ox = part.nr * o.x, oy = part.nr * o.y, dx = part.nr * d.x, dy = part.nr * d.y;
  const double a = dx * dx + dy * dy - w1 * w1;
  const double b = ox * dx + oy * dy - w0 * w1;
  const double c = ox * ox + oy * oy - w0 * w0;
  const double mx = ox * w1 - w0 * dx, my = oy * w1 - w0 * dy, turn = ox * dy - oy * dx;
  const double discriminant = mx * mx + my * my - turn * turn;
  if (!(discriminant > 0)) return;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  add(q / a);
  add(c / q);
}

void Revolution::find_curved(std::uint32_t index, const Line& line,
                             std::vector<Candidate>& found) const {
  const ProfilePart& part = parts_[index];
  const Vec3 &o = line.o, &d = line.d;
  // Newton's steps in u and s, from near the meeting.
  const auto add = [&](double u, double s) {
    const double s_before = s;
    for (int i = 0; i < 4; ++i) {
      const auto [r, r_slope] = part.r.at(u);
      const auto [z, z_slope] = part.z.at(u);
      const Vec3 p = line.at(s);
      const double f = z - p.z, g = r * r - (p.x * p.x + p.y * p.y);
      const double gu = 2 * r * r_slope, gs = -2 * (p.x * d.x + p.y * d.y);
      const double determinant = z_slope * gs + d.z * gu;
      const double du = -(f * gs + d.z * g) / determinant;
      const double ds = (gu * f - z_slope * g) / determinant;
      if (!(std::abs(du) < 1e-3) || !(std::abs(s + ds - s_before) < 1e-3)) break;
      u += du, s += ds;
    }
    found.push_back({s, index, std::clamp(u, 0.0, 1.0)});
  };
  constexpr double kLevel = 1e-5;
  if (std::abs(d.z) < kLevel) {
    const double along = o.x * d.x + o.y * d.y, turn = o.x * d.y - o.y * d.x;
    const double level = d.x * d.x + d.y * d.y;
    find_zeros(part.z + -o.z, [&](double u) {
      const double r = part.r(u), half_squared = r * r * level - turn * turn;
      if (!(half_squared >= 0)) return;
      for (const double half : {-std::sqrt(half_squared), std::sqrt(half_squared)}) {
        add(u, (half - along) / level);
      }
    });
    return;
  }
  const Bernstein<3> r = part.r * d.z, height = part.z + -o.z;
  const Bernstein<3> x = height * d.x + o.x * d.z, y = height * d.y + o.y * d.z;
  find_zeros(r * r - x * x - y * y, [&](double u) { add(u, (part.z(u) - o.z) / d.z); });
}

/// The half planes that a solid with an angle below 360° is cut by.
void Revolution::find_cuts(const Line& line, std::vector<Candidate>& found) const {
  for (const std::uint32_t end : {0u, 1u}) {
    const double azimuth = end == 0 ? 0 : angle_;
    const double c = std::cos(azimuth), sine = std::sin(azimuth);
    const double s = (sine * line.o.x - c * line.o.y) / (c * line.d.y - sine * line.d.x);
    const Vec3 p = line.at(s);
    if (std::isfinite(s) && c * p.x + sine * p.y >= -kSlack) {
      found.push_back({s, static_cast<std::uint32_t>(parts_.size()) + end});
    }
  }
}

Hit Revolution::hit(const Line& line, const Candidate& candidate, bool entering) const {
  const auto& [s, index, u] = candidate;
  Vec3 p = line.at(s), normal;
  std::uint32_t face = 0;
  if (index >= parts_.size()) {
    const std::uint32_t end = index - static_cast<std::uint32_t>(parts_.size());
    const double azimuth = end == 0 ? 0 : angle_;
    normal = Vec3{std::sin(azimuth), -std::cos(azimuth), 0} * (end == 0 ? 1.0 : -1.0);
    p -= normal * dot(p, normal);
    face = side_faces() + end;
  } else {
    const ProfilePart& part = parts_[index];
    const double rho = std::hypot(p.x, p.y);
    const Vec3 radial = rho > 0 ? Vec3{p.x / rho, p.y / rho, 0} : Vec3{};
    face = part.face;
    if (part.straight) {
      normal = normalized(radial * part.nr + Vec3{0, 0, part.nz});
      p -= normal * (part.nr * rho + part.nz * p.z - part.away);
    } else {
      const auto [r, r_slope] = part.r.at(u);
      const auto [z, z_slope] = part.z.at(u);
      p = radial * r + Vec3{0, 0, z};
      normal = normalized(radial * z_slope - Vec3{0, 0, r_slope});
    }
    if (length_squared(normal) == 0) normal = {0, 0, 1};
    // Which way a profile runs around its inside is of no account.
    if (solid() && (dot(normal, line.d) < 0) != entering) normal = -normal;
  }
  return {line.shift + s / line.speed, center_ + frame_.to_world(p * unit_),
          frame_.to_world(normal), face};
}

void Revolution::intersect(const Ray& ray, Hits& hits) const {
  const double speed = length(ray.direction);
  const Vec3 direction = ray.direction / speed;
  const double shift = dot(center_ - ray.origin, direction);
  const Line line{to_local(ray.origin + direction * shift - center_) / unit_, to_local(direction),
                  shift / speed, speed / unit_};
  if (!(length_squared(line.o) < 2.0001) || !is_finite(line.d)) return;  // r, |z| ≤ 1

  thread_local std::vector<Candidate> candidates;
  candidates.clear();
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    parts_[i].straight ? find_straight(i, line, candidates) : find_curved(i, line, candidates);
  }
  if (cut()) find_cuts(line, candidates);
  if (solid()) {
    append_crossings(
        candidates, ray.direction, [&](double s) { return inside(line.at(s)); },
        [&](const Candidate& c, bool entering) { return hit(line, c, entering); }, hits);
    return;
  }
  std::erase_if(candidates, [&](const Candidate& c) { return !within_angle(line.at(c.s)); });
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.s < b.s; });
  for (const Candidate& candidate : candidates) hits.push_back(hit(line, candidate, false));
}

/// The area that a part sweeps, in units².
double Revolution::part_area(const ProfilePart& part) const {
  if (part.straight) return angle_ * 0.5 * (part.r.c[0] + part.r.c[3]) * part.length;
  // ∫ r |(r', z')| du by Simpson's rule, whose error falls as the fourth power of the steps.
  constexpr int kSteps = 512;
  double sum = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
    const double u = static_cast<double>(i) / kSteps;
    const auto [r, r_slope] = part.r.at(u);
    sum += r * std::hypot(r_slope, part.z.at(u).slope) * weight;
  }
  return angle_ * sum / (3 * kSteps);
}

std::optional<double> Revolution::area() const {
  if (cut() && form_.smooth) return std::nullopt;
  double sum = 2 * (cut() ? isolux::area(cut_) : 0);
  for (const ProfilePart& part : parts_) sum += part_area(part);
  return sum * unit_ * unit_;
}

/// Rings of quadrilaterals, moved away from the axis by the factor that gives the true area.
TriangleSoup Revolution::part_triangles(const ProfilePart& part, double max_edge) const {
  const double widest = *std::max_element(part.r.c.begin(), part.r.c.end());
  const double columns = std::ceil(circle_segments(widest, max_edge) * form_.angle / 360);
  double size = part.length;
  for (std::size_t i = 0; i < 3 && !part.straight; ++i) {
    size += std::hypot(part.r.c[i + 1] - part.r.c[i], part.z.c[i + 1] - part.z.c[i]);
  }
  const double rows = std::max(part.straight ? 1.0 : 8.0, piece_count(size, max_edge));
  const auto rings = [&](double factor) {
    return grid(columns, rows, form_.angle == 360, [&](double column, double u) {
      const double radius = factor * part.r(u), azimuth = column * angle_;
      return Vec3{radius * std::cos(azimuth), radius * std::sin(azimuth), part.z(u)};
    });
  };
  // The secant method, for log area as a function of log factor.
  const double wanted = std::log(part_area(part));
  double before = 0, factor = 1e-3, missing_before = wanted - std::log(isolux::area(rings(1)));
  TriangleSoup soup;
  for (int i = 0; i < 20; ++i) {
    soup = rings(std::exp(factor));
    const double missing = wanted - std::log(isolux::area(soup));
    if (std::abs(missing) < 1e-12 || missing == missing_before) break;
    const double step = missing * (factor - before) / (missing_before - missing);
    before = factor, missing_before = missing, factor += step;
  }
  return soup;
}

std::optional<TriangleSoup> Revolution::triangulate(double max_edge) const {
  if (cut() && form_.smooth) return std::nullopt;
  TriangleSoup all;
  for (const ProfilePart& part : parts_) {
    append(all, part_triangles(part, max_edge / unit_));
  }
  if (solid()) {
    const ProfilePart& part = parts_.front();
    const double r = part.r(0.5), z = part.z(0.5);
    const double nr = part.z.at(0.5).slope, nz = -part.r.at(0.5).slope,
                 step = 1e-6 / std::hypot(nr, nz);
    if (encloses(parts_, r + nr * step, z + nz * step)) flip(all);
  }
  if (cut()) {
    TriangleSoup ends = cut_;
    subdivide(ends, max_edge / unit_);
    append(all, ends);
    for (Vec3& p : ends.points) p = {p.x * std::cos(angle_), p.x * std::sin(angle_), p.z};
    flip(ends);
    append(all, ends);
  }
  for (Vec3& p : all.points) p = center_ + frame_.to_world(p * unit_);
  return all;
}

ShapeDescription Revolution::describe() const {
  std::vector<std::vector<double>> rows;
  for (const auto& [r, z] : profile_) rows.push_back({r, z});
  ShapeDescription revolution{
      "revolution", {{"center", given_center_}, {"axis", frame_.n}, {"profile", rows}}, {}, {}};
  if (form_.angle != 360) revolution.fields.push_back({"angle", form_.angle});
  if (form_.smooth) revolution.fields.push_back({"smooth", true});
  if (form_.open) revolution.fields.push_back({"open", true});
  return revolution;
}

}  // namespace isolux
