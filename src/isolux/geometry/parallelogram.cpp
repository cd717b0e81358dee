#include "isolux/geometry/parallelogram.h"

#include "isolux/core/error.h"
#include "isolux/core/vectorize.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

Parallelogram::Parallelogram(const Vec3& corner, const Vec3& u, const Vec3& v)
    : corner_(corner), u_(u), v_(v) {
  require_point(corner, "corner");
  require_direction(u, "u");
  require_direction(v, "v");
  const Vec3 n = cross(u, v);
  if (!(length(n) > 1e-12 * length(u) * length(v))) {
    throw InputError("u and v: must not be parallel; they span no area");
  }
  normal_ = normalized(n);
  const double nn = length_squared(n);
  dual_u_ = cross(v, n) / nn;
  dual_v_ = cross(n, u) / nn;
}

Bounds Parallelogram::bounds() const {
  Bounds box;
  for (const Vec3& p : {corner_, corner_ + u_, corner_ + v_, corner_ + u_ + v_}) box.include(p);
  return box;
}

std::optional<PlaneHit> Parallelogram::hit(const Ray& ray) const {
  const auto h = intersect_plane(ray, corner_, normal_);
  return h && holds(h->point) ? h : std::nullopt;
}

void Parallelogram::intersect(const Ray& ray, Hits& hits) const {
  if (const auto h = hit(ray)) hits.push_back({h->t, h->point, normal_, 0});
}

bool Parallelogram::occludes(const Ray& ray, double t_min, double t_max) const {
  const auto h = hit(ray);
  return h && h->t > t_min && h->t < t_max;
}

ISOLUX_VECTORIZE
void Parallelogram::occlude_by(const Parallelogram& shape, const SegmentBlock& segments,
                               double t_max, SegmentBlock::Mask& blocked) {
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
    const PlaneCrossing at = cross_plane(segments.ray(i), shape.corner_, shape.normal_);
    blocked[i] |= at.there & (at.t > 0) & (at.t < t_max) & shape.holds(at.point);
  }
}

void Parallelogram::occlude(const SegmentBlock& segments, double t_max,
                            SegmentBlock::Mask& blocked) const {
  occlude_by(*this, segments, t_max, blocked);
}

std::optional<double> Parallelogram::area() const { return length(cross(u_, v_)); }

std::optional<TriangleSoup> Parallelogram::triangulate(double max_edge) const {
  return grid(piece_count(length(u_), max_edge), piece_count(length(v_), max_edge), false,
              [&](double a, double b) { return corner_ + u_ * a + v_ * b; });
}

ShapeDescription Parallelogram::describe() const {
  return {"parallelogram", {{"corner", corner_}, {"u", u_}, {"v", v_}}, {}, {}};
}

}  // namespace isolux
