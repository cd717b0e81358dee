#include "isolux/geometry/shape.h"

namespace isolux {

bool Shape::occludes(const Ray& ray, double t_min, double t_max) const {
  thread_local Hits hits;
  hits.clear();
  intersect(ray, hits);
  for (const Hit& hit : hits) {
    if (hit.t > t_min && hit.t < t_max) return true;
  }
  return false;
}

void Shape::occlude(const SegmentBlock& segments, double t_max, SegmentBlock::Mask& blocked) const {
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
    if (!blocked[i]) blocked[i] = occludes(segments.ray(i), 0, t_max);
  }
}

std::optional<TriangleSoup> Shape::triangulate(double /*max_edge*/) const { return std::nullopt; }

}  // namespace isolux
