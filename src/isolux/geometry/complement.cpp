#include "isolux/geometry/complement.h"

#include "isolux/core/error.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

void turn_over(Hits& hits, std::size_t first) {
  for (std::size_t i = first; i < hits.size(); ++i) hits[i].normal = -hits[i].normal;
}

}  // namespace

Complement::Complement(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {
  if (!shape_ || !shape_->solid()) {
    throw InputError(
        "only a solid can be turned inside out; close the open surface (a cylinder by "
        "capped: true, a mesh by filling its holes)");
  }
}

void Complement::intersect(const Ray& ray, Hits& hits) const {
  const std::size_t first = hits.size();
  shape_->intersect(ray, hits);
  turn_over(hits, first);
}

bool Complement::occludes(const Ray& ray, double t_min, double t_max) const {
  return shape_->occludes(ray, t_min, t_max);
}

void Complement::occlude(const SegmentBlock& segments, double t_max,
                         SegmentBlock::Mask& blocked) const {
  shape_->occlude(segments, t_max, blocked);
}

std::optional<TriangleSoup> Complement::triangulate(double max_edge) const {
  auto soup = shape_->triangulate(max_edge);
  if (soup) flip(*soup);
  return soup;
}

void Complement::intersect_part(std::size_t part, const Ray& ray, Hits& hits) const {
  const std::size_t first = hits.size();
  shape_->intersect_part(part, ray, hits);
  turn_over(hits, first);
}

bool Complement::part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const {
  return shape_->part_occludes(part, ray, t_min, t_max);
}

ShapeDescription Complement::describe() const {
  ShapeDescription inner = shape_->describe();
  if (inner.kind == "box" && !inner.flag("inward")) {
    inner.fields.push_back({"inward", true});
    return inner;
  }
  ShapeDescription complement{"complement", {}, {}, {}};
  complement.operands.push_back(std::move(inner));
  return complement;
}

}  // namespace isolux
