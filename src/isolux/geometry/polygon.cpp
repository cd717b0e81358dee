#include "isolux/geometry/polygon.h"

#include <fmt/format.h>

#include "isolux/core/error.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

using Flat = std::vector<Vec3>;  // corners in the plane, z = 0
using Corners = std::array<std::uint32_t, 3>;

/// The distance of p from the line through a and b, positive on its left.
double side(const Vec3& a, const Vec3& b, const Vec3& p) {
  return cross(b - a, p - a).z / distance(a, b);
}

/// Whether p lies in the triangle or within `slack` of it.
bool in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, double slack) {
  return side(a, b, p) >= -slack && side(b, c, p) >= -slack && side(c, a, p) >= -slack;
}

/// Whether the segments a b and c d come within `slack` of each other.
bool meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double slack) {
  const auto beside = [slack](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    const double first = side(p, q, r), second = side(p, q, s);
    return (first > slack && second > slack) || (first < -slack && second < -slack);
  };
  const Vec3 margin = Vec3{1, 1, 1} * slack;
  const Vec3 gap = max(max(min(a, b) - max(c, d), min(c, d) - max(a, b)) - margin, {});
  return gap == Vec3{} && !beside(a, b, c, d) && !beside(c, d, a, b);
}

void require_simple(const Flat& p, double slack) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % n], &c = p[(i + 2) % n];
    if (distance(a, b) <= slack) {
      throw InputError(
          fmt::format("points: corners {} and {} are the same; leave one out", i, (i + 1) % n));
    }
    if (std::abs(side(a, b, c)) <= slack && dot(b - a, c - b) < 0) {
      throw InputError(
          fmt::format("points: the outline turns back on itself at corner {}; leave the corner out",
                      (i + 1) % n));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i || !meet(p[i], p[(i + 1) % n], p[j], p[(j + 1) % n], slack)) continue;
      throw InputError(fmt::format(
          "points: the sides that start at corners {} and {} touch; order the corners so that the "
          "outline does not cross itself",
          i, j));
    }
  }
}

/// Whether the corner ring[i] can be cut off: convex, and no other corner in its triangle.
bool is_ear(const Flat& p, const std::vector<std::uint32_t>& ring, std::size_t i, double slack) {
  const std::size_t n = ring.size();
  const std::uint32_t before = ring[(i + n - 1) % n], here = ring[i], after = ring[(i + 1) % n];
  if (side(p[before], p[after], p[here]) >= -slack) return false;
  for (const std::uint32_t k : ring) {
    if (k == before || k == here || k == after) continue;
    if (in_triangle(p[k], p[before], p[here], p[after], slack)) return false;
  }
  return true;
}

std::vector<Corners> clip_ears(const Flat& p, double slack) {
  std::vector<std::uint32_t> ring(p.size());
  for (std::uint32_t i = 0; i < ring.size(); ++i) ring[i] = i;
  std::vector<Corners> triangles;
  for (std::size_t i = 0, misses = 0; ring.size() > 3; ++i) {
    const std::size_t n = ring.size();
    if (misses == n) {
      throw InputError("points: the polygon is too thin to be cut into triangles; widen it");
    }
    i %= n;
    if (!is_ear(p, ring, i, slack)) {
      ++misses;
      continue;
    }
    triangles.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    misses = 0;
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

}  // namespace

Polygon::Polygon(const std::vector<Vec3>& corners) : corners_(corners) {
  constexpr std::size_t kMostCorners = 1000;
  const std::size_t n = corners.size();
  if (n < 3 || n > kMostCorners) {
    throw InputError(fmt::format("points: a polygon has 3 to {} corners, not {}", kMostCorners, n));
  }
  for (std::size_t i = 0; i < n; ++i) {
    require_point(corners[i], fmt::format("points[{}]", i));
    bounds_.include(corners[i]);
  }
  const double size = bounds_.diagonal();
  Vec3 doubled_area;  // Newell's normal
  for (std::size_t i = 0; i < n; ++i) {
    center_ += corners[i] / static_cast<double>(n);
    doubled_area += cross(corners[i] - corners[0], corners[(i + 1) % n] - corners[0]);
  }
  if (!(length(doubled_area) > 1e-12 * size * size)) {
    throw InputError("points: the polygon has no area; its corners lie on a line or cancel out");
  }
  frame_ = Frame(normalized(doubled_area));
  bounds_ = {};
  slack_ = 1e-12 * size;
  for (std::size_t i = 0; i < n; ++i) {
    const double height = dot(corners[i] - center_, frame_.n);
    if (std::abs(height) > 1e-6 * size) {
      throw InputError(
          fmt::format("points: corner {} lies {:.3g} m off the plane of the polygon; move it "
                      "there, or use a mesh",
                      i, std::abs(height)));
    }
    soup_.points.push_back(corners[i] - frame_.n * height);
    flat_.push_back(flatten(soup_.points.back()));
    bounds_.include(soup_.points.back());
  }
  require_simple(flat_, slack_);
  soup_.triangles = clip_ears(flat_, slack_);
}

Vec3 Polygon::flatten(const Vec3& point) const {
  return {dot(point - center_, frame_.u), dot(point - center_, frame_.v), 0};
}

std::optional<PlaneHit> Polygon::hit(const Ray& ray) const {
  const auto h = intersect_plane(ray, center_, frame_.n);
  if (!h) return std::nullopt;
  const Vec3 p = flatten(h->point);
  for (const Corners& t : soup_.triangles) {
    if (in_triangle(p, flat_[t[0]], flat_[t[1]], flat_[t[2]], slack_)) return h;
  }
  return std::nullopt;
}

void Polygon::intersect(const Ray& ray, Hits& hits) const {
  if (const auto h = hit(ray)) hits.push_back({h->t, h->point, frame_.n, 0});
}

bool Polygon::occludes(const Ray& ray, double t_min, double t_max) const {
  const auto h = hit(ray);
  return h && h->t > t_min && h->t < t_max;
}

std::optional<double> Polygon::area() const { return isolux::area(soup_); }

std::optional<TriangleSoup> Polygon::triangulate(double max_edge) const {
  TriangleSoup soup = soup_;
  subdivide(soup, max_edge);
  return soup;
}

ShapeDescription Polygon::describe() const { return {"polygon", {{"points", corners_}}, {}, {}}; }

}  // namespace isolux
