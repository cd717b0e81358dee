#pragma once

#include <string_view>

#include "isolux/geometry/box_tree.h"
#include "isolux/geometry/control_point.h"
#include "isolux/geometry/patch_piece.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// Rational bicubic Bézier patches, each with its edges, so that a ray can't pass between two that
/// share one; one face. The front of each is along ∂/∂u × ∂/∂v.
///
/// Each patch is cut into pieces that are nearly flat, the parts of the shape. All hits are found;
/// where a line touches the surface, it may have two, one or none.
class PatchSurface : public Shape {
 public:
  Bounds bounds() const override { return bounds_; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  bool solid() const override { return false; }
  bool contains(const Vec3&) const override { return false; }
  /// By Gauss' quadrature.
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;

  std::size_t part_count() const override { return pieces_.size(); }
  Bounds part_bounds(std::size_t part) const override;
  void intersect_part(std::size_t part, const Ray& ray, Hits& hits) const override;
  bool part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const override;

 protected:
  using ControlPoints = std::array<ControlPoint, 16>;
  /// What is done with patches that have no area.
  enum class Degenerate { refused, left_out };

  /// Four rows of control points along u for each patch, one after the other along v. One or more
  /// of them with an area; edges may shrink to a point. Messages name `field`.
  PatchSurface(const std::vector<ControlPoints>& patches, std::string_view field,
               Degenerate degenerate);

 private:
  struct Line;
  /// Nothing where the ray surely misses all.
  std::optional<Line> line(const Ray& ray) const;
  void add_pieces(const RationalPatch& patch, int most_halvings);
  /// Calls visit(t, local point, place) for each hit of the part until one returns true; that then.
  template <typename Visit>
  bool any_hit(std::size_t part, const Line& line, const Visit& visit) const;
  void add_hits(std::size_t part, const Line& line, Hits& hits) const;
  bool blocks(std::size_t part, const Line& line, double t_min, double t_max) const;

  std::vector<RationalPatch> patches_;  ///< in the local frame, as are the pieces
  std::vector<PatchPiece> pieces_;
  BoxTree tree_{{}};  ///< of the pieces
  Bounds bounds_;
  Vec3 center_;      ///< of the bounds, the origin of the local frame
  double unit_ = 1;  ///< m, the length of the local frame: half the diagonal
};

}  // namespace isolux
