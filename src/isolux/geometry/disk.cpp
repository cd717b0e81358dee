#include "isolux/geometry/disk.h"

#include <fmt/format.h>

#include <numbers>

#include "isolux/core/error.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {

Disk::Disk(const Vec3& center, const Vec3& normal, double radius, double inner_radius)
    : center_(center), radius_(radius), inner_radius_(inner_radius) {
  require_point(center, "center");
  require_direction(normal, "normal");
  require_length(radius, "radius");
  require_length_or_zero(inner_radius, "inner_radius");
  if (radius - inner_radius < kShortestLength) {
    throw InputError(fmt::format("inner_radius: must be less than the radius, but {} >= {}",
                                 inner_radius, radius));
  }
  normal_ = unit_vector(normal);
}

Bounds Disk::bounds() const {
  const Vec3 half = circle_extent(normal_, radius_);
  return {center_ - half, center_ + half};
}

std::optional<PlaneHit> Disk::hit(const Ray& ray) const {
  const auto h = intersect_plane(ray, center_, normal_);
  if (!h) return std::nullopt;
  const double rr = length_squared(h->point - center_);
  if (rr > radius_ * radius_ || rr < inner_radius_ * inner_radius_) return std::nullopt;
  return h;
}

void Disk::intersect(const Ray& ray, Hits& hits) const {
  if (const auto h = hit(ray)) hits.push_back({h->t, h->point, normal_, 0});
}

bool Disk::occludes(const Ray& ray, double t_min, double t_max) const {
  const auto h = hit(ray);
  return h && h->t > t_min && h->t < t_max;
}

std::optional<double> Disk::area() const {
  return std::numbers::pi * (radius_ - inner_radius_) * (radius_ + inner_radius_);
}

std::optional<TriangleSoup> Disk::triangulate(double max_edge) const {
  return disk_triangles(center_, normal_, radius_, inner_radius_,
                        circle_segments(radius_, max_edge), max_edge);
}

Vec3 circle_extent(const Vec3& n, double radius) {
  return Vec3{std::hypot(n.y, n.z), std::hypot(n.z, n.x), std::hypot(n.x, n.y)} * radius;
}

ShapeDescription Disk::describe() const {
  ShapeDescription disk{
      "disk", {{"center", center_}, {"normal", normal_}, {"radius", radius_}}, {}, {}};
  if (inner_radius_ > 0) disk.fields.push_back({"inner_radius", inner_radius_});
  return disk;
}

}  // namespace isolux
