#include "isolux/geometry/csg.h"

#include "isolux/core/error.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {
namespace {

void require_solid(const std::shared_ptr<const Shape>& shape) {
  if (shape && shape->solid()) return;
  throw InputError(
      "union, intersection and difference need solids; close the open surface (a cylinder by "
      "leaving out 'open: true', a mesh by filling its holes)");
}

/// The bounds of the surface of a ∩ b, either of which may be unbounded.
Bounds intersection_bounds(const Bounds& a, bool a_unbounded, const Bounds& b, bool b_unbounded) {
  Bounds both = a;
  if (a_unbounded && b_unbounded) {
    both.include(b);
  } else if (a_unbounded) {
    both = b;
  } else if (!b_unbounded) {
    both = {max(a.lower, b.lower), min(a.upper, b.upper)};
  }
  return both;
}

}  // namespace

Csg::Csg(CsgOperation operation, std::shared_ptr<const Shape> a, std::shared_ptr<const Shape> b)
    : operation_(operation), a_(std::move(a)), b_(std::move(b)) {
  require_solid(a_);
  require_solid(b_);
  if (a_->face_count() > UINT32_MAX - b_->face_count()) {
    throw InputError("the solid has more faces than can be numbered; use simpler parts");
  }
  // All three are an intersection of the solids or of their complements.
  const bool flip_a = operation == CsgOperation::unite;
  const bool flip_b = operation != CsgOperation::intersect;
  bounds_ = intersection_bounds(a_->bounds(), a_->unbounded() != flip_a, b_->bounds(),
                                b_->unbounded() != flip_b);
  if (bounds_.empty()) {
    throw InputError("nothing is left of the solids: they do not overlap; move them together");
  }
}

bool Csg::combine(bool in_a, bool in_b) const {
  switch (operation_) {
    case CsgOperation::unite:
      return in_a || in_b;
    case CsgOperation::intersect:
      return in_a && in_b;
    case CsgOperation::subtract:
      return in_a && !in_b;
  }
  return false;
}

void Csg::intersect(const Ray& ray, Hits& hits) const {
  const std::uint32_t a_faces = a_->face_count();
  const std::size_t first = hits.size();
  a_->intersect(ray, hits);
  const std::size_t first_of_b = hits.size();
  b_->intersect(ray, hits);
  for (std::size_t i = first_of_b; i < hits.size(); ++i) {
    hits[i].face += a_faces;
    if (operation_ == CsgOperation::subtract) hits[i].normal = -hits[i].normal;
  }
  const auto at = [&](std::size_t i) { return hits.begin() + static_cast<std::ptrdiff_t>(i); };
  std::sort(at(first), hits.end(),
            [](const Hit& x, const Hit& y) { return x.t != y.t ? x.t < y.t : x.face < y.face; });

  // Every hit crosses the boundary of its solid. Those at the same place count together.
  const double size = bounds_.diagonal() / length(ray.direction);
  bool in_a = a_->unbounded(), in_b = b_->unbounded();
  std::size_t kept = first;
  for (std::size_t i = first, next = first; i < hits.size(); i = next) {
    const double reach = hits[i].t + 1e-11 * (size + std::abs(hits[i].t));
    const bool was_inside = combine(in_a, in_b);
    for (; next == i || (next < hits.size() && hits[next].t <= reach); ++next) {
      (hits[next].face < a_faces ? in_a : in_b) ^= true;
    }
    const bool is_inside = combine(in_a, in_b);
    if (was_inside == is_inside) continue;
    // The hit whose normal agrees with the crossing; of several, the one with the lowest face.
    std::size_t best = i;
    const auto agrees = [&](std::size_t j) {
      return (dot(hits[j].normal, ray.direction) < 0) == is_inside;
    };
    for (std::size_t j = i + 1; j < next; ++j) {
      const bool better = agrees(j) != agrees(best) ? agrees(j) : hits[j].face < hits[best].face;
      if (better) best = j;
    }
    hits[kept++] = hits[best];
  }
  hits.resize(kept);
}

bool Csg::contains(const Vec3& point) const {
  return combine(a_->contains(point), b_->contains(point));
}

bool Csg::unbounded() const { return combine(a_->unbounded(), b_->unbounded()); }

/// Appends the shape, or the list that it is made of where it is joined by `operation` and nothing
/// else holds it.
void Csg::list(const std::shared_ptr<const Shape>& shape, CsgOperation operation,
               std::vector<std::shared_ptr<const Shape>>& operands) {
  const auto* const csg = dynamic_cast<const Csg*>(shape.get());
  if (csg && csg->operation_ == operation && shape.use_count() == 1) {
    csg->list_operands(operands);
  } else {
    operands.push_back(shape);
  }
}

/// (a ∘ b) ∘ c is a list of three; of a difference all that is subtracted is one union.
void Csg::list_operands(std::vector<std::shared_ptr<const Shape>>& operands) const {
  list(a_, operation_, operands);
  list(b_, operation_ == CsgOperation::subtract ? CsgOperation::unite : operation_, operands);
}

ShapeDescription Csg::describe() const {
  ShapeDescription csg;
  csg.kind = operation_ == CsgOperation::unite       ? "union"
             : operation_ == CsgOperation::intersect ? "intersection"
                                                     : "difference";
  list_operands(csg.operands);
  return csg;
}

std::shared_ptr<const Shape> join(CsgOperation operation,
                                  std::span<const std::shared_ptr<const Shape>> solids) {
  if (solids.size() == 1) return solids.front();
  if (operation == CsgOperation::subtract) {
    return std::make_shared<Csg>(operation, solids.front(),
                                 join(CsgOperation::unite, solids.subspan(1)));
  }
  const std::size_t half = (solids.size() + 1) / 2;
  return std::make_shared<Csg>(operation, join(operation, solids.first(half)),
                               join(operation, solids.subspan(half)));
}

}  // namespace isolux
