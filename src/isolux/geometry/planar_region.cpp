#include "isolux/geometry/planar_region.h"

#include <fmt/format.h>

#include <numeric>

#include "isolux/core/error.h"
#include "isolux/geometry/require.h"

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

void require_holes_inside(const Flat& p, const std::vector<Ring>& rings) {
  for (std::size_t i = 1; i < rings.size(); ++i) {
    for (std::size_t j = 0; j < rings.size(); ++j) {
      if (i == j || encloses(p, {rings[j]}, p[rings[i][0]]) == (j == 0)) continue;
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

bool encloses(const Flat& corners, const std::vector<Ring>& rings, const Vec3& q) {
  bool inside = false;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 &a = corners[ring[i]], &b = corners[ring[(i + 1) % ring.size()]];
      if ((a.y > q.y) == (b.y > q.y)) continue;
      inside ^= q.x < a.x + (q.y - a.y) / (b.y - a.y) * (b.x - a.x);
    }
  }
  return inside;
}

PlanarRegion::PlanarRegion(const std::vector<Vec3>& outline,
                           const std::vector<std::vector<Vec3>>& holes) {
  constexpr std::size_t kMostCorners = 1000;
  std::vector<Vec3> given = outline;
  for (const auto& hole : holes) given.insert(given.end(), hole.begin(), hole.end());
  const std::size_t n = given.size();
  if (outline.size() < 3 || n > kMostCorners) {
    throw InputError(fmt::format("points: a polygon has 3 to {} corners, not {}", kMostCorners, n));
  }
  for (std::size_t i = 0; i < n; ++i) {
    require_point(given[i], fmt::format("points[{}]", i));
    bounds.include(given[i]);
  }
  const double size = bounds.diagonal();
  Vec3 newell;  // twice the area, along the normal
  for (std::size_t i = 0; i < outline.size(); ++i) {
    center += outline[i] / static_cast<double>(outline.size());
    newell += cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
  }
  if (!(length(newell) > 1e-12 * size * size)) {
    throw InputError("points: the polygon has no area; its corners lie on a line or cancel out");
  }
  frame = Frame(normalized(newell));
  bounds = {};
  slack = 1e-12 * size;
  for (std::size_t i = 0; i < n; ++i) {
    const double height = dot(given[i] - center, frame.n);
    if (std::abs(height) > 1e-6 * size) {
      throw InputError(
          fmt::format("points: corner {} lies {:.3g} m off the plane of the polygon; move it "
                      "there, or use a mesh",
                      i, std::abs(height)));
    }
    soup.points.push_back(given[i] - frame.n * height);
    corners.push_back(flatten(soup.points.back()));
    bounds.include(soup.points.back());
  }
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
  require_simple(corners, rings, slack);
  require_holes_inside(corners, rings);
  for (std::size_t i = 1; i < rings.size(); ++i) {
    if (doubled_area(corners, rings[i]) > 0) std::reverse(rings[i].begin(), rings[i].end());
  }
  soup.triangles = clip_ears(corners, rings, slack);
}

}  // namespace isolux
