#include "isolux/geometry/polygon.h"

#include <fmt/format.h>

#include <numeric>

#include "isolux/core/error.h"
#include "isolux/geometry/ear_clipping.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/tessellation.h"

namespace isolux {
namespace {

void require_simple(const Flat& p, const std::vector<Ring>& rings, double slack) {
  struct Side {
    std::uint32_t from, to;
  };
  std::vector<Side> sides;
  for (const Ring& ring : rings) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t at = ring[i], next = ring[(i + 1) % n];
      const Vec3 &a = p[at], &b = p[next], &c = p[ring[(i + 2) % n]];
      if (distance(a, b) <= slack) {
        throw InputError(
            fmt::format("points: corners {} and {} are the same; leave one out", at, next));
      }
      if (std::abs(line_distance(a, b, c)) <= slack && dot(b - a, c - b) < 0) {
        throw InputError(fmt::format(
            "points: the outline turns back on itself at corner {}; leave the corner out", next));
      }
      sides.push_back({at, next});
    }
  }
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const auto [a, b] = sides[i];
      const auto [c, d] = sides[j];
      if (a == d || b == c || !segments_meet(p[a], p[b], p[c], p[d], slack)) continue;
      throw InputError(fmt::format(
          "points: the sides that start at corners {} and {} touch; order the corners so that the "
          "outline does not cross itself",
          a, c));
    }
  }
}

/// Whether the ring, which does not touch q, runs around it.
bool encloses(const Flat& p, const Ring& ring, const Vec3& q) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec3 &a = p[ring[i]], &b = p[ring[(i + 1) % ring.size()]];
    if ((a.y > q.y) == (b.y > q.y)) continue;
    inside ^= q.x < a.x + (q.y - a.y) / (b.y - a.y) * (b.x - a.x);
  }
  return inside;
}

void require_holes_inside(const Flat& p, const std::vector<Ring>& rings) {
  for (std::size_t i = 1; i < rings.size(); ++i) {
    for (std::size_t j = 0; j < rings.size(); ++j) {
      if (i == j || encloses(p, rings[j], p[rings[i][0]]) == (j == 0)) continue;
      throw InputError(fmt::format("points: the hole that starts at corner {} lies {}", rings[i][0],
                                   j == 0 ? "outside the polygon" : "in another hole"));
    }
  }
}

double doubled_area(const Flat& p, const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    sum += cross(p[ring[i]] - p[ring[0]], p[ring[(i + 1) % ring.size()]] - p[ring[0]]).z;
  }
  return sum;
}

}  // namespace

Polygon::Polygon(const std::vector<Vec3>& outline, const std::vector<std::vector<Vec3>>& holes)
    : outline_(outline), holes_(holes) {
  constexpr std::size_t kMostCorners = 1000;
  std::vector<Vec3> corners = outline;
  for (const auto& hole : holes) corners.insert(corners.end(), hole.begin(), hole.end());
  const std::size_t n = corners.size();
  if (outline.size() < 3 || n > kMostCorners) {
    throw InputError(fmt::format("points: a polygon has 3 to {} corners, not {}", kMostCorners, n));
  }
  for (std::size_t i = 0; i < n; ++i) {
    require_point(corners[i], fmt::format("points[{}]", i));
    bounds_.include(corners[i]);
  }
  const double size = bounds_.diagonal();
  Vec3 newell;  // twice the area, along the normal
  for (std::size_t i = 0; i < outline.size(); ++i) {
    center_ += outline[i] / static_cast<double>(outline.size());
    newell += cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
  }
  if (!(length(newell) > 1e-12 * size * size)) {
    throw InputError("points: the polygon has no area; its corners lie on a line or cancel out");
  }
  frame_ = Frame(normalized(newell));
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
  std::vector<Ring> rings;
  std::uint32_t next = 0;
  const auto add_ring = [&](std::size_t size_of_ring) {
    if (size_of_ring < 3) throw InputError("points: a hole has at least 3 corners");
    Ring ring(size_of_ring);
    std::iota(ring.begin(), ring.end(), next);
    next += static_cast<std::uint32_t>(size_of_ring);
    rings.push_back(std::move(ring));
  };
  add_ring(outline.size());
  for (const auto& hole : holes) add_ring(hole.size());
  require_simple(flat_, rings, slack_);
  require_holes_inside(flat_, rings);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    if (doubled_area(flat_, rings[i]) > 0) std::reverse(rings[i].begin(), rings[i].end());
  }
  soup_.triangles = clip_ears(flat_, std::move(rings), slack_);
}

Vec3 Polygon::flatten(const Vec3& point) const {
  return {dot(point - center_, frame_.u), dot(point - center_, frame_.v), 0};
}

std::optional<PlaneHit> Polygon::hit(const Ray& ray) const {
  const auto h = intersect_plane(ray, center_, frame_.n);
  if (!h) return std::nullopt;
  const Vec3 p = flatten(h->point);
  for (const auto& t : soup_.triangles) {
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

ShapeDescription Polygon::describe() const {
  ShapeDescription polygon{"polygon", {{"points", outline_}}, {}, {}};
  if (!holes_.empty()) polygon.fields.push_back({"holes", holes_});
  return polygon;
}

}  // namespace isolux
