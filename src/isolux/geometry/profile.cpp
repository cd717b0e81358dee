#include "isolux/geometry/profile.h"

#include <algorithm>

#include "isolux/core/error.h"
#include "isolux/geometry/curve.h"

namespace isolux {
namespace {

ProfilePart straight_part(const ProfilePoint& from, const ProfilePoint& to, std::uint32_t face) {
  ProfilePart part;
  for (std::size_t i = 0; i < 4; ++i) {
    const double u = static_cast<double>(i) / 3;
    part.r.c[i] = i == 3 ? to[0] : from[0] + u * (to[0] - from[0]);
    part.z.c[i] = i == 3 ? to[1] : from[1] + u * (to[1] - from[1]);
  }
  part.face = face;
  const double dr = to[0] - from[0], dz = to[1] - from[1];
  part.length = std::hypot(dr, dz);
  part.nr = dz / part.length;
  part.nz = -dr / part.length;
  part.away = part.nr * from[0] + part.nz * from[1];
  return part;
}

/// A curve's arc. Handles that reach over the axis are shortened.
ProfilePart curved_part(const CurveArc& arc, std::uint32_t face) {
  const auto shortened = [](const Vec3& end, const Vec3& handle) {
    return handle.x >= 0 ? handle : end + (handle - end) * (end.x / (end.x - handle.x));
  };
  const Vec3 h1 = shortened(arc[0].p, arc[1].p), h2 = shortened(arc[3].p, arc[2].p);
  ProfilePart part;
  part.r.c = {arc[0].p.x, std::max(0.0, h1.x), std::max(0.0, h2.x), arc[3].p.x};
  part.z.c = {arc[0].p.z, h1.z, h2.z, arc[3].p.z};
  part.straight = false;
  part.face = face;
  return part;
}

/// What shapes the end of a curve: a mirror image where it meets the axis, so that it is smooth
/// there.
CurvePoint beyond(const CurvePoint& end, const CurvePoint& next) {
  if (end.p.x > 0) return straight_on(end, next);
  return {{-next.p.x, 0, next.p.z}};
}

/// Adds the curve between two corners, which is a straight line where it has no other points.
void add_curve(const std::vector<CurvePoint>& points, bool ring, std::vector<ProfilePart>& parts) {
  const std::uint32_t face = parts.empty() ? 0 : parts.back().face + 1;
  const std::size_t n = points.size();
  if (n == 2) {
    parts.push_back(
        straight_part({points[0].p.x, points[0].p.z}, {points[1].p.x, points[1].p.z}, face));
    return;
  }
  const CurvePoint before = ring ? points[n - 2] : beyond(points[0], points[1]);
  const CurvePoint after = ring ? points[1] : beyond(points[n - 1], points[n - 2]);
  for (const CurveArc& arc : curve_through(points, before, after)) {
    parts.push_back(curved_part(arc, face));
  }
}

std::vector<ProfilePart> smooth_parts(std::vector<ProfilePoint> points, bool ring) {
  // A ring begins at a corner, if it has one, which then ends it as well.
  if (ring) {
    const auto corner = std::adjacent_find(points.begin(), points.end());
    if (corner != points.end()) {
      std::rotate(points.begin(), corner + 1, points.end());
    } else {
      points.push_back(points.front());
    }
  }
  std::vector<ProfilePart> parts;
  std::vector<CurvePoint> run;
  const bool has_corner = std::adjacent_find(points.begin(), points.end()) != points.end();
  for (const auto& [r, z] : points) {
    const CurvePoint next{{r, 0, z}};
    if (!run.empty() && run.back() == next) {
      if (run.size() > 1) add_curve(run, false, parts);
      run.clear();
    }
    run.push_back(next);
  }
  if (run.size() > 1) add_curve(run, ring && !has_corner, parts);
  return parts;
}

std::vector<ProfilePart> straight_parts(const std::vector<ProfilePoint>& points, bool ring) {
  std::vector<ProfilePart> parts;
  for (std::size_t i = 0; i + (ring ? 0 : 1) < points.size(); ++i) {
    const ProfilePoint &from = points[i], &to = points[(i + 1) % points.size()];
    if (from == to || (from[0] == 0 && to[0] == 0)) continue;
    parts.push_back(straight_part(from, to, static_cast<std::uint32_t>(parts.size())));
  }
  return parts;
}

}  // namespace

std::vector<ProfilePart> profile_parts(const std::vector<ProfilePoint>& points, bool smooth,
                                       bool open) {
  if (points.size() < 2) throw InputError("profile: needs at least two points");
  const bool on_axis = points.front()[0] == 0 && points.back()[0] == 0;
  const bool ring = !open && !on_axis;
  std::vector<ProfilePart> parts =
      smooth ? smooth_parts(points, ring) : straight_parts(points, ring);
  if (parts.empty()) throw InputError("profile: has no part off the axis");
  return parts;
}

bool encloses(const std::vector<ProfilePart>& parts, double r, double z) {
  bool inside = false;
  for (const ProfilePart& part : parts) {
    const auto [lowest, highest] = std::minmax_element(part.z.c.begin(), part.z.c.end());
    if (*lowest >= z || *highest < z) continue;
    if (part.straight) {
      if ((part.z.c[0] < z) == (part.z.c[3] < z)) continue;
      const double u = (z - part.z.c[0]) / (part.z.c[3] - part.z.c[0]);
      inside ^= r < part.r.c[0] + u * (part.r.c[3] - part.r.c[0]);
    } else {
      find_zeros(part.z + -z, [&](double u) { inside ^= r < part.r(u); });
    }
  }
  return inside;
}

}  // namespace isolux
