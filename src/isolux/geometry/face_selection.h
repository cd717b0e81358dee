#pragma once

#include <memory>

#include "isolux/geometry/shape.h"

namespace isolux {

/// The faces first, first + 1 ... before `end`.
struct FaceRange {
  std::uint32_t first, end;
};

/// Some faces of a shape: what an object shows of a solid whose parts look different, where others
/// show the rest. Inside and outside are the shape's own; hits are those on the faces shown, and so
/// need not alternate, even of a solid: it is of no use in CSG.
class FaceSelection final : public Shape {
 public:
  /// The ranges ascend and don't overlap.
  FaceSelection(std::shared_ptr<const Shape> whole, std::vector<FaceRange> shown)
      : whole_(std::move(whole)), shown_(std::move(shown)) {}

  Bounds bounds() const override { return whole_->bounds(); }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool avoids(const Bounds& box) const override { return whole_->avoids(box); }
  bool solid() const override { return whole_->solid(); }
  bool contains(const Vec3& point) const override { return whole_->contains(point); }
  bool unbounded() const override { return whole_->unbounded(); }
  std::uint32_t face_count() const override { return whole_->face_count(); }
  /// That of the whole.
  ShapeDescription describe() const override;

  const std::shared_ptr<const Shape>& whole() const { return whole_; }
  const std::vector<FaceRange>& shown() const { return shown_; }
  bool shows(std::uint32_t face) const;

 private:
  std::shared_ptr<const Shape> whole_;
  std::vector<FaceRange> shown_;
};

}  // namespace isolux
