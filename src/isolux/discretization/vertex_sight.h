#pragma once

#include "isolux/discretization/facet_grids.h"
#include "isolux/discretization/surface_walk.h"

namespace isolux {

/// Which vertices have the light that is at a point, where sheets cross at small angles or lie
/// close over one another: those that can be seen from it along the surface, and hidden ones of its
/// sheet, to which light was given. Keeps the facets and the mesh by reference.
class VertexSight {
 public:
  VertexSight(const Triangulation& mesh, const FacetGrids& grids, const RayCaster& rays);

  /// Whether a vertex has the light that is there beside the point.
  bool sees(const SurfacePoint& from, VertexId v) const {
    const Vertex& vertex = mesh_.vertex(v);
    return vertex.hidden ? in_one_sheet(from, vertex) : walk_.open(from, vertex);
  }

  /// Whether over a point in this facet, by number, another may have the light: something lies
  /// over a vertex of it.
  bool doubtful(std::size_t facet) const { return covered_[facet]; }

  /// Whether the point lies as close to the facet as it may where that stands for its surface: in
  /// its plane, as far as its vertices are not turned from each other.
  bool in_sheet(const SurfacePoint& from, const Facet& facet) const;

  /// The place among those vertices that the point sees: of a triangle all of which it sees, else
  /// in the part of one.
  std::optional<MeshPlace> place(const SurfacePoint& from) const;

 private:
  bool in_one_sheet(const SurfacePoint& a, const SurfacePoint& b) const;
  double hair() const { return 4 * walk_.rays().epsilon(); }

  const Triangulation& mesh_;
  const FacetGrids& grids_;
  SurfaceWalk walk_;
  std::vector<char> covered_vertices_;
  std::vector<char> covered_;  // by facet: whether vertices of it are
};

}  // namespace isolux
