#pragma once

#include <optional>
#include <span>

#include "isolux/discretization/facet_grids.h"
#include "isolux/discretization/nearest_vertices.h"
#include "isolux/discretization/vertex_sight.h"

namespace isolux {

/// Finds the triangle over a point of the true surface, for very many points. It keeps the mesh as
/// it stood when it was built; the vertices that it gives stay valid, since ids do.
///
/// Where sheets cross at small angles, or one lies close over another, triangles of either may be
/// near a point. With `rays`, only vertices count there that can be seen from the point along the
/// surface, and those that have the light of such.
///
/// Triangles are listed by the voxels that their boxes touch, in one grid for each size of
/// triangle, so that fine and coarse parts of a mesh are equally quick. Memory: about 250 bytes a
/// triangle.
class MeshLookup {
 public:
  explicit MeshLookup(const Triangulation& mesh, const RayCaster* rays = nullptr);
  MeshLookup(const MeshLookup&) = delete;
  MeshLookup& operator=(const MeshLookup&) = delete;

  /// The place in the triangle that lies over `point`, close by, and faces as `normal` does to
  /// within 60°; nothing where no triangle does. May be asked from many threads at once.
  std::optional<MeshPlace> covering(const Vec3& point, const Vec3& normal) const;

  /// The same where rays met surfaces, first among the triangles of the objects that they met, and
  /// faster for many: places[i] is that of hits[i], nothing where that is nothing.
  void covering(std::span<const std::optional<SurfaceHit>> hits,
                std::span<std::optional<MeshPlace>> places) const;

  /// The three nearest vertices that face as `normal` does, each weighing one over the square of
  /// its distance. Nothing where no vertex within δ faces that way, within 60° if possible, else
  /// within 90°.
  std::optional<MeshPlace> nearest(const Vec3& point, const Vec3& normal) const;

  /// covering(), and where no triangle lies, nearest(), so that no light is lost there.
  std::optional<MeshPlace> place(const Vec3& point, const Vec3& normal) const;

 private:
  struct Search;
  void look_together(std::span<Search> searches) const;
  void look_among(std::span<const std::uint32_t> listed, Search& search) const;
  bool doubtful(const Search& search) const;

  FacetGrids grids_;
  NearestVertices nearest_;
  std::optional<VertexSight> sight_;
};

}  // namespace isolux
