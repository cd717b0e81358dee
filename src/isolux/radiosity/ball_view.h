#pragma once

#include "isolux/radiosity/form_factor.h"
#include "isolux/radiosity/light_lattice.h"

namespace isolux {

/// What one receiver sees of a ball, as a unit disk: its middle is the way to the centre, its rim
/// the tangents, and equal areas are equal solid angles (Lambert's azimuthal projection).
class BallView {
 public:
  /// The receiver is outside.
  BallView(const Receiver& receiver, const Ball& ball);

  /// The form factor to the ball as if nothing stood between.
  double form_factor() const { return form_factor_; }
  /// Whether no part of the ball is below the receiver's horizon.
  bool above_horizon() const { return above_horizon_; }
  /// The cosine between the receiver's normal and the direction of a point of the disk.
  double cosine(const Vec3& on_disk) const { return dot(direction(on_disk), receiver_.normal); }
  /// The first point of the ball there, a hair above it; on the rim, the tangent's.
  Vec3 point(const Vec3& on_disk) const;
  /// A box around all of these.
  Bounds bounds() const;

 private:
  Vec3 direction(const Vec3& on_disk) const;

  Receiver receiver_;
  Ball ball_;
  double distance_;  ///< d of the centre, m
  Frame frame_;      ///< its third axis points to the centre
  double versine_;   ///< 1 − cos α, α the half-angle of the ball, sin α = radius / d
  double form_factor_;
  bool above_horizon_;
};

}  // namespace isolux
