#pragma once

#include "isolux/geometry/shape.h"

namespace isolux {

/// One ball of a blob: its field is strength (1 − d²/radius²)² at the distance d < radius (m) from
/// its centre, and 0 beyond. A negative strength makes a dent.
struct BlobBall {
  Vec3 center;
  double radius = 0;
  double strength = 1;
};

/// Balls that flow into each other: the solid where their fields add up to more than the threshold
/// (> 0, less than the strengths together). After Blinn's "blobby molecules" (1982), with a
/// polynomial field as in Wyvill, McPheeters and Wyvill (1986). One face.
class Blob final : public Shape {
 public:
  Blob(double threshold, std::vector<BlobBall> balls);

  Bounds bounds() const override { return bounds_; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  ShapeDescription describe() const override;

 private:
  Vec3 local(const Vec3& point) const { return (point - center_) / unit_; }
  Vec3 outward(const Vec3& local_point, const Vec3& otherwise) const;

  double threshold_;
  std::vector<BlobBall> given_;
  std::vector<BlobBall> balls_;  ///< in the local frame
  Bounds bounds_;
  Vec3 center_;      ///< of the bounds, the origin of the local frame
  double unit_ = 1;  ///< m, the length of the local frame
};

}  // namespace isolux
