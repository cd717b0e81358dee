#pragma once

#include <functional>
#include <queue>
#include <span>
#include <vector>

#include "isolux/core/random.h"
#include "isolux/discretization/light_reach.h"
#include "isolux/discretization/point_spacing.h"
#include "isolux/discretization/sheet_grid.h"
#include "isolux/discretization/surface_walk.h"

namespace isolux {

/// A point of a cover before it is a vertex.
struct CoverPoint : ZonePoint, PointSpacing {
  Vec3 inward;  ///< unit, on creases: from the crease into the surface; else zero
  bool on_crease() const { return length_squared(inward) > 0; }
};

/// Strews points over all surfaces that it is shown a point of: first along the creases, a hair
/// inside, and at their corners; then between them, no two closer than about their size.
class CoverPoints {
 public:
  /// `spacing`: the largest size, m. `keep_going`, if any: as in CoverOptions.
  CoverPoints(const SurfaceWalk& walk, const LightReach& light, double spacing, std::uint64_t seed,
              std::function<bool()> keep_going = {});

  /// Covers the smooth surface around `point` with points, and those that adjoin it, as far as
  /// they are not covered yet.
  void grow_from(const ZonePoint& point);

  /// Strews the points between creases once more, the finest first, now that all creases are known:
  /// so sizes grow smoothly away from what is small.
  void settle();

  std::span<const CoverPoint> points() const { return points_; }
  const SheetGrid& grid() const { return grid_; }

 private:
  struct Ending {  // of the surface, in a direction
    Vec3 direction;
    double distance;  // m; a crease is there, within some 2 % of the size
    ZonePoint last;   // of the surface before it
  };
  struct Surroundings : PointSpacing {
    double to_crease = std::numeric_limits<double>::infinity();
    bool lit = true;  // else it ends the dark: no more points are looked for from there
    std::vector<Ending> creases = {};
  };
  struct CreaseSeed {
    ZonePoint from;
    Vec3 direction;
    double distance;
    double size;     // m: the spacing in that direction
    ZonePoint last;  // of the surface, to within some 2 % of the size
  };
  struct CreasePoint {
    ZonePoint point;  // on the crease, or less than the walk's tolerance inside
    Vec3 outward;     // unit, tangential, across the crease
    PointSpacing spacing;
    // Where it is a corner: a point on the other crease, and the direction across that.
    bool corner = false;
    ZonePoint turn_off_from = {};
    Vec3 turn_off = {};

    /// Along the crease, to the left seen from outside the surface when looking outward.
    Vec3 left() const { return normalized(cross(point.normal, outward)); }
    double step() const { return spacing.along(left()); }  // m: to the crease's next point
    void shorten(double step);
  };
  bool turns_at_once(const ZonePoint& point, const ZonePoint& there, double away,
                     const Vec3& d) const;
  Surroundings look_around(const ZonePoint& point, const Vec3& first, const PointSpacing& most,
                           double crease_ahead = -1);
  Ending ending(const ZonePoint& point, const Vec3& d, double near, double far, double past,
                double guess, Rim& rim) const;
  void look_along(const ZonePoint& point, Surroundings& around) const;
  void adjoin(const ZonePoint& a, const ZonePoint& b) {
    grid_.adjoin(a.surface.object, b.surface.object);
  }
  static bool level(const SurfacePoint& q, const SurfacePoint& point);
  bool crowded(const ZonePoint& point, const PointSpacing& spacing) const;
  bool crowded_by(std::span<const std::uint32_t> ids, const ZonePoint& point,
                  const PointSpacing& spacing) const;
  PointSpacing graded(const ZonePoint& point, const PointSpacing& most) const;
  bool surrounded(const ZonePoint& point) const;
  bool crowded_in_sight(const ZonePoint& point) const;
  void begin_at(const ZonePoint& point);
  Vec3 any_direction(const ZonePoint& point);
  void look_from(const ZonePoint& point, const PointSpacing& most);
  double largest_on(const ZonePoint& point) const { return largest_[point.surface.object]; }
  void spawn(std::uint32_t parent);
  bool in_the_dark(const ZonePoint& point, double sizes) const;
  bool lit(const ZonePoint& point, double sizes = 1);
  void accept(const ZonePoint& point, const Surroundings& around);
  void add(const CoverPoint& point, const Surroundings& around);
  void spawn_all();
  void run_creases();
  struct Gap {
    double width;  // m
    Vec3 slope;    // tangential
  };
  std::optional<Gap> gap_over(const ZonePoint& point, double most) const;
  std::optional<ZonePoint> contact_beside(const CoverPoint& from) const;
  bool going();

  void trace(const CreaseSeed& seed);
  bool on_sheet_of(const CoverPoint& q, const SurfacePoint& point) const;
  bool known(const SurfacePoint& point, const Vec3& outward) const;
  std::optional<Vec3> outward_at(const ZonePoint& rim, const Vec3& direction, double size) const;
  std::optional<CreasePoint> next_on_crease(const CreasePoint& from, const Vec3& along,
                                            double step) const;
  std::optional<CreasePoint> corner(const CreasePoint& a, const Vec3& along, const CreasePoint& b,
                                    double step) const;
  void follow(const CreasePoint& from, const Vec3& along, std::vector<CreasePoint>& chain,
              bool& closed);
  std::optional<CreasePoint> corner_ahead(const CreasePoint& from, const Vec3& along, double step,
                                          double reached) const;
  static bool met(const std::vector<CreasePoint>& chain, const CreasePoint& next, double step);
  void even_out(std::vector<CreasePoint>& chain) const;
  void fit_spacings(std::vector<CreasePoint>& chain, bool closed) const;
  void commit(const std::vector<CreasePoint>& chain, bool closed);
  void look_across(const CreasePoint& crease);
  double fineness(double size) const;
  PointSpacing spacing_inside(const CreasePoint& crease, double limit);

  const SurfaceWalk& walk_;
  const LightReach& light_;
  double spacing_;
  std::vector<double> largest_;  // size on each object, m: a quarter of it, half of a small one
  Random random_;
  SheetGrid grid_;
  GradedGrid crease_grid_;  // those on creases, of all surfaces
  SheetGrid dark_grid_;
  std::vector<ZonePoint> dark_;  // where light does not come, each for the patch around it
  std::vector<CoverPoint> points_;
  std::vector<Surroundings> surroundings_;                // of the points, their creases left out
  std::vector<std::vector<std::uint32_t>> along_crease_;  // neighbours on the same crease
  using Front = std::pair<double, std::uint32_t>;
  std::priority_queue<Front, std::vector<Front>, std::greater<>> front_;  // finest first
  std::vector<CreaseSeed> crease_seeds_;
  std::vector<ZonePoint> beyond_;  // points of adjoining surfaces, to be grown from
  std::function<bool()> keep_going_;
  std::size_t steps_ = 0;  // as counted by going()
  bool stopped_ = false;
};

}  // namespace isolux
