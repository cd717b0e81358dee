#pragma once

#include "isolux/geometry/patch_surface.h"

namespace isolux {

/// Bicubic Bézier patches.
class Bezier final : public PatchSurface {
 public:
  using Points = std::vector<Vec3>;

  /// Each patch has 16 control points (m): four rows along u, one after the other along v. One or
  /// more of them, each with an area; edges may shrink to a point.
  explicit Bezier(std::vector<Points> patches);

  ShapeDescription describe() const override;

 private:
  static std::vector<ControlPoints> control_points(const std::vector<Points>& patches);

  std::vector<Points> given_;
};

}  // namespace isolux
