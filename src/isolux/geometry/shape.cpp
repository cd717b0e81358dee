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

std::optional<TriangleSoup> Shape::triangulate(double /*max_edge*/) const { return std::nullopt; }

}  // namespace isolux
