#pragma once

#include <span>
#include <vector>

#include "isolux/core/random.h"
#include "isolux/discretization/mesh_rays.h"
#include "isolux/radiosity/options.h"
#include "isolux/radiosity/pairing.h"
#include "isolux/radiosity/statistics.h"
#include "isolux/radiosity/visibility.h"

namespace isolux {

/// The unshot light of one triangle on its way (T of §3.2.1).
struct Shot {
  TriangleId triangle = 0;
  Emitter emitter;
  Rgb radiosity;  ///< lm/m²
};

/// The refinement of the triangulation by rays (§3.2.3 to 3.2.6): holds rays against the true
/// geometry and against the triangulation side by side, and mends the triangulation where the two
/// disagree. Results do not depend on the number of threads: rays of a batch are traced in
/// parallel, then answered one after the other.
class Refinement {
 public:
  /// All four must outlive it; counts go to `statistics`.
  Refinement(Triangulation& mesh, const RayCaster& rays, const Options& options,
             Statistics& statistics);

  /// Procedure Refine(T) (§3.2.3): rays from each corner of the shooting triangle. Vertices that
  /// are born get the shot's light exactly, and earlier light from their neighbours.
  void refine(const Shot& shot);

  /// The eye pass (§3.2.6): jittered rays through the camera's picture, in random order.
  void refine_from_eye(const Camera& camera);

  /// The last loop of procedure Radiosity: splits each triangle whose vertices' ΔE's are too
  /// different (rule 5), at the point of the scene over its centre. `delta`: the luminance of each
  /// vertex's ΔE, lx.
  void split_triangles(const Shot& shot, std::span<const double> delta);

 private:
  void refine_along(const Vec3& origin, std::span<const Vec3> directions, const Shot* shot);
  void compare(std::span<const SurfaceHit> scene_hits, std::span<const MeshHit> mesh_hits,
               const Shot* shot);
  void remove_from_triangulation(const MeshHit& hit, std::span<const MeshHit> mesh_hits,
                                 std::span<const HitPair> pairs);
  void extend_triangulation(const SurfaceHit& hit, const Shot* shot);
  void refine_triangulation(const MeshHit& mesh_hit, const SurfaceHit& hit, const Shot* shot);
  std::optional<SurfaceHit> scene_point_over_center(const Triangle& triangle) const;
  void light_newborn(Vertex& vertex, const Rgb& earlier, const Shot* shot);
  SurfacePoint surface_point(const SurfaceHit& hit) const;

  Triangulation& mesh_;
  const RayCaster& rays_;
  const Options& options_;
  Statistics& statistics_;
  MeshRays mesh_rays_;
  Random random_;
  double cos_normal_tolerance_;
  // Kept between calls for their memory alone: the hits of each ray of a batch, and of one ray.
  std::vector<std::vector<SurfaceHit>> scene_hits_;
  std::vector<std::vector<MeshHit>> mesh_hits_;
  std::vector<MeshHit> merged_;
  std::vector<HitPair> pairs_;
};

}  // namespace isolux
