#include "isolux/geometry/polygon.h"

#include "isolux/core/vectorize.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

Polygon::Polygon(const std::vector<Vec3>& outline, const std::vector<std::vector<Vec3>>& holes)
    : outline_(outline), holes_(holes), region_(outline, holes) {
  for (const auto& corners : region_.soup.triangles) {
    auto& sides = triangles_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& a = region_.corners[corners[k]];
      const Vec3 along = normalized(region_.corners[corners[(k + 1) % 3]] - a);
      sides[k] = {-along.y, along.x, along.x * a.y - along.y * a.x - region_.slack};
    }
  }
}

std::optional<PlaneHit> Polygon::hit(const Ray& ray) const {
  const auto h = intersect_plane(ray, region_.center, region_.frame.n);
  if (!h) return std::nullopt;
  const Vec3 p = region_.flatten(h->point);
  for (const auto& [a, b, c] : triangles_) {
    if (a.holds(p.x, p.y) && b.holds(p.x, p.y) && c.holds(p.x, p.y)) return h;
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

ISOLUX_VECTORIZE
void Polygon::occlude_by(const Polygon& polygon, const SegmentBlock& segments, double t_max,
                         SegmentBlock::Mask& blocked) {
  const PlanarRegion& region = polygon.region_;
  alignas(64) SegmentBlock::Lanes x, y;
  alignas(64) SegmentBlock::Mask crossed, within{};
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
    const PlaneCrossing at = cross_plane(segments.ray(i), region.center, region.frame.n);
    const Vec3 p = region.flatten(at.point);
    x[i] = p.x, y[i] = p.y;
    crossed[i] = at.there & (at.t > 0) & (at.t < t_max);
  }
  for (const auto& [a, b, c] : polygon.triangles_) {
    for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
      within[i] |= a.holds(x[i], y[i]) & b.holds(x[i], y[i]) & c.holds(x[i], y[i]);
    }
  }
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) blocked[i] |= crossed[i] & within[i];
}

void Polygon::occlude(const SegmentBlock& segments, double t_max,
                      SegmentBlock::Mask& blocked) const {
  occlude_by(*this, segments, t_max, blocked);
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
