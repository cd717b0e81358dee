#pragma once

#include <vector>

#include "isolux/core/random.h"
#include "isolux/discretization/surface_walk.h"

namespace isolux {

/// Whether light can reach a point of a scene, straight or by reflection: not the inside of a
/// closed drawer, nor the outer side of a room's walls. Light is sent out first, to learn a few
/// places of each object that it reaches; a point that sees such a place, or from where a random
/// path of reflections leads to a point that sees one, is reached too. Gaps that hardly a path in
/// a hundred finds do not count. What a camera of the scene sees counts as reached, to be shown as
/// dark as it is.
class LightReach {
 public:
  /// `walk` must outlive it. Where the scene has no light, everything counts as reached.
  LightReach(const SurfaceWalk& walk, std::uint64_t seed);

  /// Whether a light, or a place that light reaches, is seen from the point, as far as a few rays
  /// can tell.
  bool sees_light(const SurfacePoint& point, Random& random) const;

  /// Whether a random path of reflections from the point leads to where a light, or a place that
  /// light reaches, is seen. Cost: some hundreds of rays where none does.
  bool is_on_path_of_light(const SurfacePoint& point, Random& random) const;

  /// Whether light reaches the point, straight or so. Cost: a few rays where it does.
  bool reaches(const SurfacePoint& point, Random& random) const {
    return sees_light(point, random) || is_on_path_of_light(point, random);
  }

  /// A point of the same surface close by, if one is found: surfaces that touch leave a hairline
  /// between them, and a point in there tells nothing of the rest.
  std::optional<ZonePoint> beside(const ZonePoint& point, Random& random) const;

 private:
  struct Place {
    Vec3 position;  ///< a hair above the surface
    Vec3 normal;
  };
  Place above(const Vec3& position, const Vec3& normal) const;
  void find_lights(std::uint64_t seed);
  std::size_t kinds() const;
  Ray first_ray(std::size_t kind, Random& random) const;
  void send_light(std::uint64_t seed);
  std::optional<Place> reflected(const Ray& ray, std::uint32_t& object) const;
  bool opens_to(const Place& place, const Vec3& from) const;
  bool lit_straight(const Place& place, Random& random) const;
  bool sees_lit_place(const Place& place, Random& random) const;

  const RayCaster& rays_;
  const SurfaceWalk& walk_;
  const double diagonal_;                   ///< of the scene, m
  std::vector<std::vector<Place>> lights_;  ///< of each object that emits
  std::vector<Place> lit_;                  ///< a few of each object
};

}  // namespace isolux
