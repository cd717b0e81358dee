#pragma once

#include <memory>
#include <span>
#include <vector>

#include "isolux/discretization/triangulation.h"
#include "isolux/raycast/triangle_tree.h"

namespace isolux {

/// A point where a ray meets a triangle of the triangulation (I_d of §3.2.3).
/// Its `triangle` is a TriangleId.
using MeshHit = TriangleHit;

/// Rays against a growing triangulation: a tree over the triangles that stood when it was last
/// built, and a list of those born since. The triangulation must outlive it.
class MeshRays {
 public:
  explicit MeshRays(const Triangulation& mesh);
  ~MeshRays();
  MeshRays(const MeshRays&) = delete;
  MeshRays& operator=(const MeshRays&) = delete;

  /// Brings the tree up to date where enough triangles were born since it was built. Not while
  /// another thread asks.
  void update();

  /// All hits with living triangles, from both sides, in ascending t, into `hits` (cleared
  /// first). May be asked from many threads while the triangulation stands still.
  void all_hits(const Ray& ray, Interval within, std::vector<MeshHit>& hits) const;

  /// The same for many rays, faster: hits[i] are those of rays[i].
  void all_hits(std::span<const Ray> rays, Interval within,
                std::span<std::vector<MeshHit>> hits) const;

  /// As all_hits(), but only the triangles with id ≥ `first`; appends, unsorted.
  void hits_since(TriangleId first, const Ray& ray, Interval within,
                  std::vector<MeshHit>& hits) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace isolux
