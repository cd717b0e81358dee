#pragma once

#include "isolux/core/affine.h"
#include "isolux/geometry/crossings.h"
#include "isolux/geometry/planar_region.h"

namespace isolux {

/// How the outline of a prism changes from the base to the top: it is first turned, then scaled,
/// both in proportion to the height.
struct PrismTop {
  Vec3 center;  ///< m, a point of the axis (which runs along the prism) about which both happen
  /// Factors at the top, ≥ 0 (0: a point or an edge): the first along x as it lies in the plane of
  /// the base (y where the normal is within 26° of x), the second across it.
  std::array<double, 2> scale = {1, 1};
  double twist = 0;  ///< degrees, right-handed about `along`, within ± 3600
};

/// The solid that a PlanarRegion passes over while it moves along a vector out of its plane. Its
/// sides are flat without a twist and with equal factors, ruled surfaces otherwise. Face 0 is the
/// base, 1 the top, the others the sides in the order of the corners.
class Prism final : public Shape {
 public:
  Prism(const std::vector<Vec3>& outline, const std::vector<std::vector<Vec3>>& holes,
        const Vec3& along, const std::optional<PrismTop>& top = {});

  Bounds bounds() const override;
  void intersect(const Ray& ray, Hits& hits) const override;
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  std::uint32_t face_count() const override {
    return 2 + static_cast<std::uint32_t>(sides_.size());
  }
  /// Known where all faces are flat.
  std::optional<double> area() const override;
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

 private:
  /// A side of the base in the local frame, the region on its left.
  struct Side {
    Vec3 from, to;
    Vec3 normal;          ///< in the plane, outward, unit
    double length, away;  ///< away: of its line from the origin, along the normal
  };
  struct Line;

  bool flat() const { return twist_ == 0 && top_scale_.x == top_scale_.y; }
  Vec3 scale_at(double z) const { return Vec3{1, 1, 0} * (1 - z) + top_scale_ * z; }
  Vec3 to_base(const Vec3& p) const;
  Vec3 from_base(const Vec3& q, double z) const;
  bool contains_local(const Vec3& p) const;
  void find_sides(const Line& line, double a, double b, std::vector<Candidate>& found) const;
  Hit hit(const Line& line, const Candidate& candidate) const;

  std::vector<Vec3> outline_;             ///< as given
  std::vector<std::vector<Vec3>> holes_;  ///< as given
  std::optional<PrismTop> top_;           ///< as given
  Vec3 along_;
  PlanarRegion region_;
  Affine to_world_, to_local_;  ///< local: base in z = 0, top in z = 1, the axis through the origin
  Flat corners_;                ///< of the base, local
  std::vector<Side> sides_;
  Vec3 top_scale_{1, 1, 0};
  double twist_ = 0;  ///< rad
  Bounds local_bounds_;
};

}  // namespace isolux
