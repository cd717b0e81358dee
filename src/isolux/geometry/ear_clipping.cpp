#include "isolux/geometry/ear_clipping.h"

#include <algorithm>
#include <functional>
#include <tuple>

#include "isolux/core/error.h"

namespace isolux {
namespace {

using Corners = std::array<std::uint32_t, 3>;

[[noreturn]] void fail_as_thin() {
  throw InputError("points: the polygon is too thin to be cut into triangles; widen it");
}

/// Whether ring[i], looking from there, has `target` within its angle.
bool opens_towards(const Flat& p, const Ring& ring, std::size_t i, const Vec3& target) {
  const std::size_t n = ring.size();
  const Vec3 &before = p[ring[(i + n - 1) % n]], &here = p[ring[i]], &after = p[ring[(i + 1) % n]];
  const bool convex = cross(here - before, after - here).z > 0;
  const bool left_of_first = cross(here - before, target - here).z > 0;
  const bool left_of_second = cross(after - here, target - here).z > 0;
  return convex ? left_of_first && left_of_second : left_of_first || left_of_second;
}

/// Whether the segment between two corners meets no side but those that end at them.
bool sees(const Flat& p, const std::vector<Ring>& rings, std::uint32_t a, std::uint32_t b,
          double slack) {
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t c = ring[i], d = ring[(i + 1) % ring.size()];
      if (c == a || c == b || d == a || d == b) continue;
      if (segments_meet(p[a], p[b], p[c], p[d], slack)) return false;
    }
  }
  return true;
}

/// Joins the last ring to another by the shortest segment between corners that runs within the
/// region, which is then passed there and back.
void join_last_ring(const Flat& p, std::vector<Ring>& rings, double slack) {
  struct Bridge {
    double length_squared;
    std::size_t ring, place, place_in_last;
    bool operator>(const Bridge& b) const {
      return std::tie(length_squared, ring, place, place_in_last) >
             std::tie(b.length_squared, b.ring, b.place, b.place_in_last);
    }
  };
  const Ring last = rings.back();
  std::vector<Bridge> bridges;  // a heap, the shortest on top: mostly one of the first will do
  for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      for (std::size_t k = 0; k < last.size(); ++k) {
        bridges.push_back({length_squared(p[rings[r][i]] - p[last[k]]), r, i, k});
      }
    }
  }
  std::make_heap(bridges.begin(), bridges.end(), std::greater<>());
  while (!bridges.empty()) {
    std::pop_heap(bridges.begin(), bridges.end(), std::greater<>());
    const Bridge b = bridges.back();
    bridges.pop_back();
    Ring& ring = rings[b.ring];
    const std::uint32_t here = ring[b.place], there = last[b.place_in_last];
    if (!opens_towards(p, ring, b.place, p[there]) ||
        !opens_towards(p, last, b.place_in_last, p[here]) || !sees(p, rings, here, there, slack)) {
      continue;
    }
    Ring detour;  // around the last ring, and back to where it began
    for (std::size_t k = 0; k <= last.size(); ++k) {
      detour.push_back(last[(b.place_in_last + k) % last.size()]);
    }
    detour.push_back(here);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(b.place) + 1, detour.begin(),
                detour.end());
    rings.pop_back();
    return;
  }
  fail_as_thin();
}

/// Whether the corner ring[i] can be cut off: convex, and no other corner in its triangle.
bool is_ear(const Flat& p, const Ring& ring, std::size_t i, double slack) {
  const std::size_t n = ring.size();
  const std::uint32_t before = ring[(i + n - 1) % n], here = ring[i], after = ring[(i + 1) % n];
  const Vec3 &a = p[before], &b = p[here], &c = p[after];
  if (before == after || line_distance(a, c, b) >= -slack) return false;
  const Vec3 margin = Vec3{1, 1, 1} * slack;
  const Vec3 lower = min(min(a, b), c) - margin, upper = max(max(a, b), c) + margin;
  for (const std::uint32_t k : ring) {
    const Vec3& q = p[k];
    if (q.x < lower.x || q.x > upper.x || q.y < lower.y || q.y > upper.y) continue;
    if (k == before || k == here || k == after) continue;
    if (in_triangle(q, a, b, c, slack)) return false;
  }
  return true;
}

}  // namespace

double line_distance(const Vec3& a, const Vec3& b, const Vec3& p) {
  return cross(b - a, p - a).z / distance(a, b);
}

bool in_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, double slack) {
  return line_distance(a, b, p) >= -slack && line_distance(b, c, p) >= -slack &&
         line_distance(c, a, p) >= -slack;
}

bool segments_meet(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, double slack) {
  const auto beside = [slack](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
    const double first = line_distance(p, q, r), second = line_distance(p, q, s);
    return (first > slack && second > slack) || (first < -slack && second < -slack);
  };
  const Vec3 margin = Vec3{1, 1, 1} * slack;
  const Vec3 gap = max(max(min(a, b) - max(c, d), min(c, d) - max(a, b)) - margin, {});
  return gap == Vec3{} && !beside(a, b, c, d) && !beside(c, d, a, b);
}

Ring with_seams(const Flat& p, std::vector<Ring> rings, double slack) {
  while (rings.size() > 1) join_last_ring(p, rings, slack);
  return rings.front();
}

std::vector<Corners> clip_ears(const Flat& p, std::vector<Ring> rings, double slack) {
  Ring ring = with_seams(p, std::move(rings), slack);
  std::vector<Corners> triangles;
  for (std::size_t i = 0, misses = 0; ring.size() > 3; ++i) {
    const std::size_t n = ring.size();
    if (misses == n) fail_as_thin();
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

}  // namespace isolux
