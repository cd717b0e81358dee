#pragma once

#include "isolux/geometry/bicubic.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// Bicubic Bézier patches, each with its edges, so that a ray can't pass between two that share
/// one; one part a patch, one face. The front of each is along ∂/∂u × ∂/∂v.
///
/// Hits of a line are the common zeros of two polynomials in u and v: how far the patch is off the
/// line in two directions. Pieces of the patch whose control points show that there is none are
/// dropped, those that have one at most are searched by Newton's method, all others halved
/// (subdivision with the convex hull, as in Nishita, Sederberg and Kakimoto 1990). All are found;
/// where a line touches the surface, it may have two, one or none.
class Bezier final : public Shape {
 public:
  using Points = std::vector<Vec3>;

  /// Each patch has 16 control points (m): four rows along u, one after the other along v. One or
  /// more of them, each with an area; edges may shrink to a point.
  explicit Bezier(std::vector<Points> patches);

  Bounds bounds() const override { return bounds_; }
  /// Asks every patch; ray casters use the parts.
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  bool solid() const override { return false; }
  bool contains(const Vec3&) const override { return false; }
  /// By Gauss' quadrature.
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

  std::size_t part_count() const override { return given_.size(); }
  Bounds part_bounds(std::size_t part) const override;
  void intersect_part(std::size_t part, const Ray& ray, Hits& hits) const override;
  bool part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const override;

 private:
  using Patch = std::array<Bicubic, 3>;  ///< x, y and z, in the local frame
  double patch_area(const Patch& patch) const;

  std::vector<Points> given_;
  std::vector<Patch> patches_;
  Bounds bounds_;
  Vec3 center_;      ///< of the bounds, the origin of the local frame
  double unit_ = 1;  ///< m, the length of the local frame: half the diagonal
};

}  // namespace isolux
