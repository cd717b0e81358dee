#pragma once

#include <optional>
#include <vector>

#include "isolux/geometry/bicubic_zeros.h"
#include "isolux/geometry/ray.h"

namespace isolux {

/// A rational bicubic Bézier patch: x, y and z, each times the weight, and the weight, which is
/// more than 0.
struct RationalPatch {
  std::array<Bicubic, 4> part;

  struct PointAndSlopes {
    Vec3 point, along_u, along_v;
  };
  PointAndSlopes at(const Place& place) const;
  /// A control point.
  Vec3 point(std::size_t i) const {
    return Vec3{part[0].c[i], part[1].c[i], part[2].c[i]} / part[3].c[i];
  }
  std::array<RationalPatch, 2> split(int axis, double t) const;
};

/// A piece of a patch, of about the size 1 or smaller, and how lines find where they meet it.
///
/// It has an oblique frame of its own: the tangents in its middle are the first two axes, the
/// normal there is the third. In that frame a line has a place (x, y) for each height, and meets
/// the piece where two polynomials are zero. Most lines pass by the box around the piece in its
/// frame. For the others, bounds found once tell whether the direction has one hit at most, which
/// Newton's method then finds; only lines that graze the piece cut it into smaller ones.
class PatchPiece {
 public:
  explicit PatchPiece(const RationalPatch& patch);

  /// The box around its control points.
  const Bounds& bounds() const { return bounds_; }
  /// Whether most lines have one hit at most.
  bool flat() const;
  /// Along which axis of the parameters, 0 or 1, it is less even.
  int bent_axis() const;

  /// Adds where the line meets the piece, each place once. The direction has length 1.
  void find(const Ray& line, std::vector<Place>& places) const;
  Vec3 point(const Place& place) const;
  /// The unit normal along ∂/∂u × ∂/∂v; where an edge has shrunk to a point, that beside it.
  std::optional<Vec3> normal(const Place& place) const;

 private:
  struct Range {
    double middle, half_width;
  };

  void search(const Ray& line, std::vector<Place>& places) const;
  Vec3 to_world(double x, double y, double h) const { return u_ * x + v_ * y + normal_ * h; }

  Vec3 middle_;
  Vec3 u_, v_, normal_;   ///< the frame's axes
  Vec3 x_axis_, y_axis_;  ///< what x and y are the products with
  Range x_range_, y_range_, h_range_;
  /// How far the slopes along u and v together are from those in the middle at most.
  double x_bend_, y_bend_, h_bend_, weight_bend_;
  Bicubic x_, y_, h_, weight_;  ///< the first three times the weight, which is 1 in the middle
  Bounds bounds_;
};

}  // namespace isolux
