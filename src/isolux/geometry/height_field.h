#pragma once

#include "isolux/core/affine.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// Heights over the grid points of a parallelogram, and flat triangles between: each cell is cut
/// from its second corner (along u) to its third (along v). Rays are marched through the cells, so
/// that millions of triangles need no more memory than their heights. Its front is where the
/// heights, which count along u × v, grow to. One face.
class HeightField final : public Shape {
 public:
  /// `corner`, `u` and `v` (m) as of a parallelogram. `heights` (m) row by row: each row runs along
  /// u, one after the other along v; 2 to 4096 of each.
  HeightField(const Vec3& corner, const Vec3& u, const Vec3& v,
              std::vector<std::vector<double>> heights);

  Bounds bounds() const override { return bounds_; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool solid() const override { return false; }
  bool contains(const Vec3&) const override { return false; }
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  /// A triangle's plane: the height at (x, y) is z + x_slope (x − x0) + y_slope (y − y0).
  struct Facet {
    double x0, y0, z, x_slope, y_slope;

    double height(double x, double y) const { return z + x_slope * (x - x0) + y_slope * (y - y0); }
  };
  Facet facet(double x, double y) const;
  TriangleSoup soup() const;

  Vec3 corner_, u_, v_;  ///< as given
  std::vector<std::vector<double>> heights_;
  std::size_t columns_, rows_;  ///< of cells
  double lowest_, highest_;
  Affine to_world_, to_local_;  ///< local: cells are unit squares, z the height in m
  Bounds bounds_;
};

}  // namespace isolux
