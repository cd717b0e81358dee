#pragma once

#include "isolux/geometry/b_spline.h"
#include "isolux/geometry/patch_surface.h"

namespace isolux {

/// A surface of non-uniform rational B-splines (Piegl and Tiller 1997, 4.4), as the rational Bézier
/// patches that it consists of. Those that have shrunk to a line or a point are left out.
class Nurbs final : public PatchSurface {
 public:
  using Points = std::vector<std::vector<Vec3>>;
  using Weights = std::vector<std::vector<double>>;

  /// `points` (m) row by row: each row runs along u, one after the other along v. A weight, more
  /// than 0, for each of them; 1 where there are none.
  Nurbs(KnotVector u, KnotVector v, Points points, Weights weights = {});

  ShapeDescription describe() const override;

 private:
  static std::vector<ControlPoints> patches(const KnotVector& u, const KnotVector& v,
                                            const Points& points, const Weights& weights);

  KnotVector u_, v_;
  Points points_;
  Weights weights_;
};

}  // namespace isolux
