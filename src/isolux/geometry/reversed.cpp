#include "isolux/geometry/reversed.h"

#include "isolux/core/error.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

void turn_over(Hits& hits, std::size_t first) {
  for (std::size_t i = first; i < hits.size(); ++i) hits[i].normal = -hits[i].normal;
}

}  // namespace

Reversed::Reversed(std::shared_ptr<const Shape> shape) : shape_(std::move(shape)) {
  if (!shape_) throw InputError("only a shape can be turned over");
}

void Reversed::intersect(const Ray& ray, Hits& hits) const {
  const std::size_t first = hits.size();
  shape_->intersect(ray, hits);
  turn_over(hits, first);
}

bool Reversed::occludes(const Ray& ray, double t_min, double t_max) const {
  return shape_->occludes(ray, t_min, t_max);
}

void Reversed::occlude(const SegmentBlock& segments, double t_max,
                       SegmentBlock::Mask& blocked) const {
  shape_->occlude(segments, t_max, blocked);
}

std::optional<TriangleSoup> Reversed::triangulate(double max_edge) const {
  auto soup = shape_->triangulate(max_edge);
  if (soup) flip(*soup);
  return soup;
}

void Reversed::intersect_part(std::size_t part, const Ray& ray, Hits& hits) const {
  const std::size_t first = hits.size();
  shape_->intersect_part(part, ray, hits);
  turn_over(hits, first);
}

bool Reversed::part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const {
  return shape_->part_occludes(part, ray, t_min, t_max);
}

ShapeDescription Reversed::describe() const { return {"reversed", {}, {shape_}, {}}; }

}  // namespace isolux
