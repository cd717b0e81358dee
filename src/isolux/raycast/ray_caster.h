#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

/// A smooth piece of a scene's surface: a face of an object's shape.
struct SurfaceId {
  std::uint32_t object = 0;
  std::uint32_t face = 0;

  bool operator==(const SurfaceId&) const = default;
};

/// A point of the scene that a ray meets.
struct SurfaceHit {
  double t = 0;  ///< along the ray, in lengths of its direction
  Vec3 point;    ///< on the true surface, in double precision
  Vec3 normal;   ///< unit length, to the side that receives light
  SurfaceId surface;
  bool back = false;  ///< on the side that the shape's own normal points away from
};

/// The open piece t_min < t < t_max of a ray.
struct Interval {
  double min = 0;
  double max = std::numeric_limits<double>::infinity();
};

/// A straight way that light may take between two points.
struct Segment {
  Vec3 from, to;
};

/// The objects that may stand between two boxes, or that they are too many to be listed.
class Blockers {
 public:
  bool none() const { return count_ == 0 && !many_; }

 private:
  friend class RayCaster;
  static constexpr std::size_t kMost = 16;
  std::array<std::uint32_t, kMost> objects_{};
  std::size_t count_ = 0;
  bool many_ = false;
};

/// Answers rays against the true geometry of a scene. The scene must outlive it and stay as it is.
/// All queries may be asked from many threads at once; their answers depend on nothing but the
/// ray.
///
/// Rays look forward only, whatever the interval. What is guaranteed: a hit whose t lies strictly
/// inside the interval is reported, one on or outside its ends is not, t being computed in double
/// precision on the true surface (relative error about 1e-12 of the distance from the origin). Rays
/// that start on a surface do not skip it: start them `epsilon()` along the normal, or t_min past
/// it.
class RayCaster {
 public:
  explicit RayCaster(const Scene& scene);
  ~RayCaster();
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  const Scene& scene() const;

  /// A length that is small against everything in the scene (1e-7 of its diagonal, m), by which
  /// points on surfaces are lifted off them.
  double epsilon() const { return epsilon_; }

  /// The first hit; its normal faces the ray's origin where the surface has two sides. Where
  /// surfaces of two objects coincide, as for all_hits(), but those that face the ray go first.
  std::optional<SurfaceHit> nearest(const Ray& ray, Interval within = {}) const;

  /// The same for many rays at once, faster where neighbours in the list run close together.
  void nearest(std::span<const Ray> rays, std::span<std::optional<SurfaceHit>> hits) const;

  /// All hits, in ascending t, into `hits` (cleared first). A surface with two sides gives two
  /// hits at the same t, the one that faces the ray first. Where surfaces of two objects coincide
  /// (equal t within epsilon, facing alike), only one is there: a light before others, then the
  /// object that comes later in the scene.
  void all_hits(const Ray& ray, Interval within, std::vector<SurfaceHit>& hits) const;

  /// Whether anything lies strictly between the ends of the segment, the last millionth of its
  /// length left out.
  bool occluded(const Segment& segment) const;

  /// The same for many segments at once, faster where neighbours in the list run close together:
  /// blocked[i] = 1 where segments[i] is occluded, else 0.
  void occluded(std::span<const Segment> segments, std::span<std::uint8_t> blocked) const;

  /// What may stand anywhere between the two boxes; the object of the index `except`, if any, is
  /// not looked at.
  Blockers blockers(const Bounds& from, const Bounds& to,
                    std::optional<std::uint32_t> except = {}) const;

  /// Whether surely nothing stands there, so that no segment from one box to the other is
  /// occluded.
  bool clear(const Bounds& from, const Bounds& to) const { return blockers(from, to).none(); }

  /// occluded() for segments from one box to another whose blockers are given; much faster where
  /// these are few.
  void occluded(const Blockers& among, std::span<const Segment> segments,
                std::span<std::uint8_t> blocked) const;

  /// Whether a point of a surface, a hair along its normal, lies inside another solid (or outside
  /// the room): light never gets there.
  bool buried(const Vec3& point, const Vec3& normal) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
  double epsilon_;
};

}  // namespace isolux
