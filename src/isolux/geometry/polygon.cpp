#include "isolux/geometry/polygon.h"

#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

Polygon::Polygon(const std::vector<Vec3>& outline, const std::vector<std::vector<Vec3>>& holes)
    : outline_(outline), holes_(holes), region_(outline, holes) {}

std::optional<PlaneHit> Polygon::hit(const Ray& ray) const {
  const auto h = intersect_plane(ray, region_.center, region_.frame.n);
  if (!h) return std::nullopt;
  const Vec3 p = region_.flatten(h->point);
  for (const auto& t : region_.soup.triangles) {
    if (in_triangle(p, region_.corners[t[0]], region_.corners[t[1]], region_.corners[t[2]],
                    region_.slack))
      return h;
  }
  return std::nullopt;
}

void Polygon::intersect(const Ray& ray, Hits& hits) const {
  if (const auto h = hit(ray)) hits.push_back({h->t, h->point, region_.frame.n, 0});
}

bool Polygon::occludes(const Ray& ray, double t_min, double t_max) const {
  const auto h = hit(ray);
  return h && h->t > t_min && h->t < t_max;
}

std::optional<double> Polygon::area() const { return isolux::area(region_.soup); }

std::optional<TriangleSoup> Polygon::triangulate(double max_edge) const {
  TriangleSoup soup = region_.soup;
  subdivide(soup, max_edge);
  return soup;
}

ShapeDescription Polygon::describe() const {
  ShapeDescription polygon{"polygon", {{"points", outline_}}, {}, {}};
  if (!holes_.empty()) polygon.fields.push_back({"holes", holes_});
  return polygon;
}

}  // namespace isolux
