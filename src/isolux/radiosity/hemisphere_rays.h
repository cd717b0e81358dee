#pragma once

#include <vector>

#include "isolux/core/random.h"
#include "isolux/radiosity/form_factor.h"
#include "isolux/radiosity/row.h"
#include "isolux/raycast/ray_caster.h"
#include "isolux/sampling/concentric.h"

namespace isolux {

/// Rays from a receiver over its hemisphere, by the cells of a square of grid × grid: the square is
/// mapped to the disk, turned by a random angle and lifted to the hemisphere, so that all cells
/// have the same share of the form factor.
class HemisphereRays {
 public:
  /// `lift`, m: from where on the normal they start. `random` must outlive it.
  HemisphereRays(const Receiver& receiver, double lift, int grid, Random& random);

  /// Where a direction of unit length lies in the square [−1, 1]²; below the horizon, on its rim.
  Point2 square_of(const Vec3& direction) const;

  /// A random ray in each cell, and in each part of a divided one.
  void send_to_cells();
  void send_to_parts(const DividedCell& divided);

  /// Those sent so far, in the order of Row::rays.
  std::span<const Ray> rays() const { return rays_; }

 private:
  void send(double i, double j);

  Frame frame_;
  Vec3 origin_;
  int grid_;
  Random& random_;
  double cosine_ = 1, sine_ = 0;  // of the angle that the disk is turned by
  std::vector<Ray> rays_;
};

}  // namespace isolux
