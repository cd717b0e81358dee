#pragma once

#include <memory>
#include <span>

#include "isolux/geometry/shape.h"

namespace isolux {

enum class CsgOperation { unite, intersect, subtract };

/// Two solids made one: a ∪ b, a ∩ b or a \ b (Roth 1982). Its faces are those of `a`, then those
/// of `b` (numbered on from a's); the faces of what is subtracted look the other way.
///
/// Where boundaries coincide (within 1e-11 of the size of the solid and of the distance from the
/// ray's origin), a line passes both at once: walls thinner than that vanish, and hits there are
/// a's where both serve.
class Csg final : public Shape {
 public:
  /// Throws InputError where a or b is not solid, or the intersection is empty by its bounds.
  Csg(CsgOperation operation, std::shared_ptr<const Shape> a, std::shared_ptr<const Shape> b);

  /// The bounds of the surface; not the tightest where curved parts are cut off.
  Bounds bounds() const override { return bounds_; }
  void intersect(const Ray& ray, Hits& hits) const override;
  bool solid() const override { return true; }
  bool contains(const Vec3& point) const override;
  bool unbounded() const override;
  std::uint32_t face_count() const override { return a_->face_count() + b_->face_count(); }
  ShapeDescription describe() const override;

 private:
  bool combine(bool in_a, bool in_b) const;
  static void list(const std::shared_ptr<const Shape>& shape, CsgOperation operation,
                   std::vector<std::shared_ptr<const Shape>>& operands);
  void list_operands(std::vector<std::shared_ptr<const Shape>>& operands) const;

  CsgOperation operation_;
  std::shared_ptr<const Shape> a_, b_;
  Bounds bounds_;
};

/// The union or intersection of all solids (one at least), or the first without all the others:
/// by halves, so that a ray's way down to any of n solids is log2 n steps. Throws as Csg does.
std::shared_ptr<const Shape> join(CsgOperation operation,
                                  std::span<const std::shared_ptr<const Shape>> solids);

}  // namespace isolux
