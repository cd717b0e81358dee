#include "isolux/geometry/sphere.h"

#include <numbers>

#include "isolux/core/vectorize.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

using std::numbers::pi;

/// Where a line crosses a sphere: t = middle ± half; `nearest` is its point at `middle`, seen from
/// the centre.
struct Chord {
  double middle;
  double half;
  Vec3 nearest;
};

std::optional<Chord> chord(const Ray& ray, const Vec3& center, double radius) {
  const double dd = length_squared(ray.direction);
  const Vec3 to_origin = ray.origin - center;
  const double middle = -dot(to_origin, ray.direction) / dd;
  const Vec3 nearest = to_origin + ray.direction * middle;
  const double missing = length(nearest);
  const double half_squared = (radius - missing) * (radius + missing) / dd;
  if (!(half_squared > 0)) return std::nullopt;
  return Chord{middle, std::sqrt(half_squared), nearest};
}

/// chord() of many lines, and whether one of its ends has 0 < t < t_max.
ISOLUX_VECTORIZE
void occlude_by_sphere(const SegmentBlock& segments, const Vec3& center, double radius,
                       double t_max, SegmentBlock::Mask& blocked) {
  for (std::size_t i = 0; i < SegmentBlock::kLanes; ++i) {
    const Ray ray = segments.ray(i);
    const double dd = length_squared(ray.direction);
    const Vec3 to_origin = ray.origin - center;
    const double middle = -dot(to_origin, ray.direction) / dd;
    const double missing = length(to_origin + ray.direction * middle);
    const double half_squared = (radius - missing) * (radius + missing) / dd;
    // Not a number where the line misses, so that nothing below holds.
    const double half = std::sqrt(half_squared);
    const double enter = middle - half, leave = middle + half;
    blocked[i] |=
        (half_squared > 0) & (((enter > 0) & (enter < t_max)) | ((leave > 0) & (leave < t_max)));
  }
}

/// The icosahedron of circumradius 1.
TriangleSoup icosahedron() {
  constexpr double g = std::numbers::phi;
  TriangleSoup soup;
  soup.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                 {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Vec3& p : soup.points) p = normalized(p);
  // The cap around corner 0, the cap around corner 3 opposite to it, and the belt between them.
  constexpr std::array<std::uint32_t, 5> upper = {11, 5, 1, 7, 10}, lower = {4, 9, 8, 6, 2};
  for (std::size_t i = 0; i < 5; ++i) {
    const std::size_t next = (i + 1) % 5;
    soup.triangles.push_back({0, upper[i], upper[next]});
    soup.triangles.push_back({3, lower[next], lower[i]});
    soup.triangles.push_back({upper[i], lower[i], upper[next]});
    soup.triangles.push_back({upper[next], lower[i], lower[next]});
  }
  return soup;
}

}  // namespace

Sphere::Sphere(const Vec3& center, double radius) : center_(center), radius_(radius) {
  require_point(center, "center");
  require_length(radius, "radius");
}

Bounds Sphere::bounds() const {
  const Vec3 half = Vec3{1, 1, 1} * radius_;
  return {center_ - half, center_ + half};
}

void Sphere::intersect(const Ray& ray, Hits& hits) const {
  const auto c = chord(ray, center_, radius_);
  if (!c) return;
  for (const double step : {-c->half, c->half}) {
    const Vec3 normal = normalized(c->nearest + ray.direction * step);
    hits.push_back({c->middle + step, center_ + normal * radius_, normal, 0});
  }
}

bool Sphere::occludes(const Ray& ray, double t_min, double t_max) const {
  const auto c = chord(ray, center_, radius_);
  if (!c) return false;
  const double enter = c->middle - c->half, leave = c->middle + c->half;
  return (enter > t_min && enter < t_max) || (leave > t_min && leave < t_max);
}

void Sphere::occlude(const SegmentBlock& segments, double t_max,
                     SegmentBlock::Mask& blocked) const {
  occlude_by_sphere(segments, center_, radius_, t_max, blocked);
}

bool Sphere::contains(const Vec3& point) const {
  return length_squared(point - center_) < radius_ * radius_;
}

std::optional<double> Sphere::area() const { return 4 * pi * radius_ * radius_; }

std::optional<TriangleSoup> Sphere::triangulate(double max_edge) const {
  // At least as fine as a circle of 8 segments.
  TriangleSoup soup = icosahedron();
  subdivide(soup, std::min(max_edge / radius_, 2 * std::sin(pi / 8)), normalized);
  for (Vec3& p : soup.points) p = center_ + p * radius_;
  scale_to_area(soup, center_, *area());
  return soup;
}

ShapeDescription Sphere::describe() const {
  return {"sphere", {{"center", center_}, {"radius", radius_}}, {}, {}};
}

}  // namespace isolux
