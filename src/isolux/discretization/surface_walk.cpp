#include "isolux/discretization/surface_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace isolux {
namespace {

// A surface that turns by up to α_n within a step is found within this part of the step's length
// from the tangent plane.
constexpr double kReach = 0.6;
// What lies between two points is passed over at these parts of the drop between them: a quarter
// is how far an arc bulges, half where the turn is made at one edge.
constexpr std::array kLifts{0.3, 0.55};

/// How far each of two points lies under the other's tangent plane at most, m.
double drop_between(const SurfacePoint& a, const SurfacePoint& b) {
  const Vec3 d = b.position - a.position;
  return std::max({0.0, -dot(d, a.normal), dot(d, b.normal)});
}

}  // namespace

SurfaceWalk::SurfaceWalk(const RayCaster& rays, double normal_tolerance)
    : rays_(rays), tolerance_(normal_tolerance), cos_tolerance_(std::cos(normal_tolerance)) {}

std::optional<ZonePoint> SurfaceWalk::at(const SurfaceHit& hit) const {
  if (rays_.buried(hit.point, hit.normal)) return std::nullopt;
  const Scene& scene = rays_.scene();
  ZonePoint found;
  found.position = hit.point;
  found.normal = hit.normal;
  found.surface = hit.surface;
  found.reflectance = scene.material_of(hit.surface.object).reflectance;
  if (!hit.back) found.emission = scene.objects[hit.surface.object].exitance;
  return found;
}

std::optional<ZonePoint> SurfaceWalk::over(const ZonePoint& from, const Vec3& target) const {
  const Vec3 d = target - from.position;
  const Vec3 along = d - from.normal * dot(d, from.normal);
  thread_local std::vector<Sheet> sheets;
  find_sheets(from.position + along, from.normal, kReach * length(along), sheets);
  if (sheets.empty()) return std::nullopt;
  // Another sheet may lie nearer to the tangent plane, but hidden, as behind a hollow one. Nor does
  // the surface go on where it would have to rise more than it has turned.
  const auto goes_on = [&](const Sheet& sheet) {
    const double cosine = dot(sheet.hit.normal, from.normal);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    if (sheet.height * cosine > length(along) * sine + rays_.epsilon()) return false;
    SurfacePoint there;
    there.position = sheet.hit.point, there.normal = sheet.hit.normal;
    return open(from, there);
  };
  auto sheet = sheets.begin();
  if (sheets.size() > 1) sheet = std::ranges::find_if(sheets, goes_on);
  return in_zone(from, sheet != sheets.end() ? *sheet : sheets.front());
}

std::optional<ZonePoint> SurfaceWalk::nearest(const ZonePoint& guess, double reach) const {
  thread_local std::vector<Sheet> sheets;
  find_sheets(guess.position, guess.normal, reach, sheets);
  return sheets.empty() ? std::nullopt : in_zone(guess, sheets.front());
}

/// All sheets over or under a point that face as `normal` does, no further than `reach` (m) and a
/// little, the nearest first.
void SurfaceWalk::find_sheets(const Vec3& point, const Vec3& normal, double reach,
                              std::vector<Sheet>& sheets) const {
  const double far = reach + 16 * rays_.epsilon();
  thread_local std::vector<SurfaceHit> hits;
  rays_.all_hits({point + normal * far, -normal}, {0, 2 * far}, hits);
  sheets.clear();
  for (const SurfaceHit& hit : hits) {
    if (dot(hit.normal, normal) >= cos_tolerance_) sheets.push_back({hit, std::abs(hit.t - far)});
  }
  if (sheets.size() > 1) std::ranges::stable_sort(sheets, {}, &Sheet::height);
}

/// The point of the sheet; nothing where light can't reach it, or it is of another zone.
std::optional<ZonePoint> SurfaceWalk::in_zone(const ZonePoint& zone, const Sheet& sheet) const {
  std::optional<ZonePoint> found = at(sheet.hit);
  if (found && (found->reflectance != zone.reflectance || found->emission != zone.emission)) {
    return std::nullopt;
  }
  return found;
}

/// `room`: how high over the surface, in epsilons, nothing may stand.
bool SurfaceWalk::open(const SurfacePoint& a, const SurfacePoint& b, double room) const {
  const double drop = drop_between(a, b);
  for (const double part : kLifts) {
    const double lift = part * drop + room * rays_.epsilon();
    if (!rays_.occluded({a.position + a.normal * lift, b.position + b.normal * lift})) return true;
    if (drop == 0) return false;
  }
  return false;
}

std::optional<ZonePoint> SurfaceWalk::step(const ZonePoint& from, const Vec3& target) const {
  std::optional<ZonePoint> found = over(from, target);
  if (found && !open(from, *found, kRoomToWalk)) return std::nullopt;
  return found;
}

Rim SurfaceWalk::rim(const ZonePoint& from, const Vec3& direction, double near, double far,
                     double tolerance, double guess) const {
  Rim rim{from, near};
  if (near > 0) {
    if (const auto start = over(from, from.position + direction * near)) rim.point = *start;
  }
  const auto runs_on_to = [&](double away) {
    const auto found = step(from, from.position + direction * away);
    if (found) {
      rim = {*found, away};
    } else {
      far = away;
    }
    return found.has_value();
  };
  if (guess > near && guess < far) {
    constexpr double kWider = 8;
    for (double hair = 0.45 * tolerance;; hair *= kWider) {
      const bool so_far = guess - hair <= rim.distance || runs_on_to(guess - hair);
      const bool no_further = guess + hair >= far || !runs_on_to(guess + hair);
      if (so_far && no_further) break;
    }
  }
  while (far - rim.distance > tolerance) runs_on_to(0.5 * (rim.distance + far));
  return rim;
}

}  // namespace isolux
