#pragma once

#include "isolux/geometry/reversed.h"

namespace isolux {

/// A solid turned inside out: all space but it. The complement of a box is a room seen from inside.
class Complement final : public Reversed {
 public:
  /// Throws InputError where `shape` is not solid.
  explicit Complement(std::shared_ptr<const Shape> shape);

  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override { return !shape_->contains(point); }
  bool unbounded() const override { return !shape_->unbounded(); }
  ShapeDescription describe() const override;
};

}  // namespace isolux
