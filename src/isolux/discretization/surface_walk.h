#pragma once

#include <optional>
#include <vector>

#include "isolux/discretization/triangulation.h"

namespace isolux {

/// A point of the scene with what its side of the surface emits. Points are of one *zone* where
/// they reflect and emit alike.
struct ZonePoint : SurfacePoint {
  Rgb emission;  ///< lm/m²
};

/// Where the last point of a surface lies before it ends, seen from a point on it.
struct Rim {
  ZonePoint point;      ///< still on the surface
  double distance = 0;  ///< how far the walk got, in the tangent plane it began in, m
};

/// Walks along the scene's surfaces by rays alone. A surface runs on from one point to another
/// where a short ray finds it there, of the same zone and its normal within α_n, not buried in a
/// solid, and nothing stands between. It ends at a *crease*: an edge, a wall, the foot of another
/// solid, a change of zone.
class SurfaceWalk {
 public:
  SurfaceWalk(const RayCaster& rays, double normal_tolerance);

  /// The point that light can reach where `hit` is; nothing where it is buried.
  std::optional<ZonePoint> at(const SurfaceHit& hit) const;

  /// The point of the surface of `from` over or under `target`, along the normal of `from`: of
  /// several sheets there, the nearest to its tangent plane that it may go on in.
  std::optional<ZonePoint> over(const ZonePoint& from, const Vec3& target) const;

  /// The point of the sheet nearest to `guess`, over or under it along its normal, that faces as
  /// that does; nothing where none is found within `reach` (m) or it is of another zone.
  std::optional<ZonePoint> nearest(const ZonePoint& guess, double reach) const;

  /// As over(), where besides nothing stands between.
  std::optional<ZonePoint> step(const ZonePoint& from, const Vec3& target) const;

  /// Whether nothing stands on the surface between two points of it.
  bool open(const SurfacePoint& a, const SurfacePoint& b) const { return open(a, b, kRoom); }

  /// Where the surface ends between two distances (m) from `from` in the tangential unit
  /// `direction`: it runs on as far as `near`, and not as far as `far`; to within `tolerance` (m).
  /// Cheaper where it ends at about the distance `guess` (m), if that lies between.
  Rim rim(const ZonePoint& from, const Vec3& direction, double near, double far, double tolerance,
          double guess = -1) const;

  double cos_normal_tolerance() const { return cos_tolerance_; }
  double normal_tolerance() const { return tolerance_; }
  const RayCaster& rays() const { return rays_; }

 private:
  // What lies less than so many of the caster's epsilons over a surface is passed over. Walks need
  // more room: so points at the end of a wedge between crossing sheets are surely under the upper.
  static constexpr double kRoom = 4, kRoomToWalk = 8;
  bool open(const SurfacePoint& a, const SurfacePoint& b, double room) const;
  struct Sheet {
    SurfaceHit hit;
    double height;  // m: over or under the point it was looked for at
  };
  void find_sheets(const Vec3& point, const Vec3& normal, double reach,
                   std::vector<Sheet>& sheets) const;
  std::optional<ZonePoint> in_zone(const ZonePoint& zone, const Sheet& sheet) const;

  const RayCaster& rays_;
  double tolerance_, cos_tolerance_;
};

}  // namespace isolux
