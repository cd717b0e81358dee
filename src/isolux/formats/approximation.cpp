#include "isolux/formats/approximation.h"

#include <algorithm>

#include "isolux/core/affine.h"
#include "isolux/geometry/face_selection.h"

namespace isolux {
namespace {

/// A grid of cubes around a shape, its places numbered along x first. Places and cells have the
/// same numbers: a cell is named by its lowest corner.
class Contouring {
 public:
  Contouring(const Shape& shape, int cells);

  /// One point for each cell that the surface passes, one quadrilateral for each edge.
  TriangleSoup soup();
  bool coarse() const { return coarse_; }
  double size() const { return size_; }

 private:
  using Place = std::array<int, 3>;

  /// Where the surface passes the edges of a cell: sums over n (n·(x − p))², the squares of the
  /// distances from its tangent planes (p relative to the cell's lowest corner, in cells).
  struct Crossed {
    std::uint32_t vertex = 0;
    int count = 0;
    Vec3 middle, pull;
    std::array<Vec3, 3> planes;
  };

  std::size_t number(const Place& at) const {
    return (static_cast<std::size_t>(at[2]) * counts_[1] + at[1]) * counts_[0] + at[0];
  }
  Vec3 position(const Place& at) const {
    return corner_ + Vec3{double(at[0]), double(at[1]), double(at[2])} * size_;
  }
  template <typename Visit>
  void visit_lines(int axis, const Visit& visit) const;
  void find_inside();
  void cross_edge(int axis, const Place& from, const Hit* hit);
  Vec3 vertex(const Place& at, const Crossed& cell) const;

  const Shape& shape_;
  double size_;  ///< m, of a cell
  Vec3 corner_;
  std::array<int, 3> counts_;  ///< of places
  std::vector<char> inside_;
  std::vector<std::uint32_t> cells_;  ///< 1 + the place in crossed_, or 0
  std::vector<std::pair<Place, Crossed>> crossed_;
  struct Edge {
    int axis;
    Place from;
  };
  std::vector<Edge> edges_;
  bool coarse_ = false;
};

Contouring::Contouring(const Shape& shape, int cells) : shape_(shape) {
  const Bounds box = shape.bounds();
  const Vec3 extent = box.upper - box.lower;
  size_ = std::max({extent.x, extent.y, extent.z}) / cells;
  // Off the middle by a part of a cell, so that no side of a box lies in the grid.
  corner_ = box.lower - Vec3{0.637, 0.618, 0.656} * size_;
  std::size_t places = 1;
  for (int axis = 0; axis < 3; ++axis) {
    counts_[axis] = 3 + static_cast<int>(std::ceil(extent[axis] / size_));
    places *= counts_[axis];
  }
  inside_.resize(places);
  cells_.resize(places);
  find_inside();
}

/// Calls visit(first place, hits) for each line of the grid; t counts from the first, in cells.
template <typename Visit>
void Contouring::visit_lines(int axis, const Visit& visit) const {
  const int across = (axis + 1) % 3, up = (axis + 2) % 3;
  Vec3 way;
  way[axis] = size_;
  Hits hits;
  Place at{};
  for (at[up] = 0; at[up] < counts_[up]; ++at[up]) {
    for (at[across] = 0; at[across] < counts_[across]; ++at[across]) {
      hits.clear();
      shape_.intersect({position(at), way}, hits);
      visit(at, hits);
    }
  }
}

/// Which side of the surface the places are on, by the hits along x.
void Contouring::find_inside() {
  int far_inside = 0;  // whether lines come from inside: most votes win
  std::vector<Place> free;
  visit_lines(0, [&](Place at, const Hits& hits) {
    if (hits.empty()) return free.push_back(at);
    far_inside += hits.front().normal.x > 0 ? 1 : -1;
    std::size_t next = 0;
    for (; at[0] < counts_[0]; ++at[0]) {
      while (next < hits.size() && hits[next].t <= at[0]) ++next;
      inside_[number(at)] = next < hits.size() ? hits[next].normal.x > 0 : hits.back().normal.x < 0;
    }
  });
  for (Place at : free) {
    for (; at[0] < counts_[0]; ++at[0]) inside_[number(at)] = far_inside > 0;
  }
}

/// Tells the four cells around an edge that the surface passes it, at the hit or in its middle.
void Contouring::cross_edge(int axis, const Place& from, const Hit* hit) {
  const int across = (axis + 1) % 3, up = (axis + 2) % 3;
  if (from[across] == 0 || from[up] == 0) return;  // outside the bounds
  edges_.push_back({axis, from});
  Vec3 crossing = position(from);
  crossing[axis] += 0.5 * size_;
  if (hit) crossing = hit->point;
  for (int i = 0; i < 4; ++i) {
    Place at = from;
    at[across] -= i & 1;
    at[up] -= i >> 1;
    std::uint32_t& index = cells_[number(at)];
    if (index == 0) {
      crossed_.push_back({at, {}});
      index = static_cast<std::uint32_t>(crossed_.size());
    }
    Crossed& cell = crossed_[index - 1].second;
    const Vec3 p = (crossing - position(at)) / size_;
    ++cell.count;
    cell.middle += p;
    if (!hit) continue;
    const Vec3& n = hit->normal;
    for (int row = 0; row < 3; ++row) cell.planes[row] += n * n[row];
    cell.pull += n * dot(n, p);
  }
}

/// The point nearest to the tangent planes, drawn a little to the middle of the crossings so that
/// flat cells have one as well, and kept within the cell.
Vec3 Contouring::vertex(const Place& at, const Crossed& cell) const {
  constexpr double kDraw = 1e-3;
  const Vec3 middle = cell.middle / cell.count;
  Affine planes{cell.planes, {}};
  const Vec3 pull = cell.pull - planes.vector(middle);
  for (int i = 0; i < 3; ++i) planes.linear[i][i] += kDraw;
  const auto inverse = planes.inverse();
  const Vec3 best = inverse ? middle + inverse->vector(pull) : middle;
  return position(at) + max({}, min({1, 1, 1}, best)) * size_;
}

TriangleSoup Contouring::soup() {
  for (int axis = 0; axis < 3; ++axis) {
    visit_lines(axis, [&](Place at, const Hits& hits) {
      auto hit = hits.begin();
      for (; at[axis] + 1 < counts_[axis]; ++at[axis]) {
        Place next = at;
        ++next[axis];
        while (hit != hits.end() && hit->t <= at[axis]) ++hit;
        auto last = hit;
        for (; last != hits.end() && last->t <= next[axis]; ++last) {
          // Two surfaces, back to back, within one edge.
          coarse_ |= last != hit && dot(last->normal, std::prev(last)->normal) < -0.5;
        }
        if (inside_[number(at)] != inside_[number(next)]) {
          cross_edge(axis, at, hit == last ? nullptr : &*hit);
        }
        hit = last;
      }
    });
  }
  TriangleSoup soup;
  for (auto& [at, cell] : crossed_) {
    cell.vertex = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back(vertex(at, cell));
  }
  for (const auto& [axis, from] : edges_) {
    std::array<std::uint32_t, 4> corners;  // counter-clockwise about the edge
    for (int i = 0; i < 4; ++i) {
      Place at = from;
      at[(axis + 1) % 3] -= i == 0 || i == 3;
      at[(axis + 2) % 3] -= i < 2;
      corners[i] = crossed_[cells_[number(at)] - 1].second.vertex;
    }
    if (!inside_[number(from)]) std::swap(corners[1], corners[3]);
    const auto& p = soup.points;
    const auto& [a, b, c, d] = corners;
    if (distance(p[a], p[c]) <= distance(p[b], p[d])) {
      soup.triangles.push_back({a, b, c});
      soup.triangles.push_back({a, c, d});
    } else {
      soup.triangles.push_back({b, c, d});
      soup.triangles.push_back({b, d, a});
    }
  }
  return soup;
}

/// How far the middles of about 4000 triangles are from the shape along their normals; the length
/// of a side where there is nothing.
double deviation(const Shape& shape, const TriangleSoup& soup) {
  const std::size_t step = 1 + soup.triangles.size() / 4000;
  double most = 0;
  Hits hits;
  for (std::size_t i = 0; i < soup.triangles.size(); i += step) {
    const auto& [a, b, c] = soup.triangles[i];
    const Vec3 &p = soup.points[a], &q = soup.points[b], &r = soup.points[c];
    const Vec3 normal = normalized(cross(q - p, r - p));
    if (normal == Vec3{}) continue;
    hits.clear();
    shape.intersect({(p + q + r) / 3, normal}, hits);
    double nearest = std::max({distance(p, q), distance(q, r), distance(r, p)});
    for (const Hit& hit : hits) nearest = std::min(nearest, std::abs(hit.t));
    most = std::max(most, nearest);
  }
  return most;
}

/// Leaves the triangles that stand for faces shown.
void select(const FaceSelection& selection, TriangleSoup& soup) {
  Hits hits;
  std::erase_if(soup.triangles, [&](const auto& t) {
    const Vec3 &p = soup.points[t[0]], &q = soup.points[t[1]], &r = soup.points[t[2]];
    hits.clear();
    selection.whole()->intersect({(p + q + r) / 3, normalized(cross(q - p, r - p))}, hits);
    const auto nearest = std::min_element(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
      return std::abs(a.t) < std::abs(b.t);
    });
    return nearest == hits.end() || !selection.shows(nearest->face);
  });
}

/// Without the triangles that have no area.
void clean(TriangleSoup& soup) {
  std::erase_if(soup.triangles, [&](const auto& t) {
    const Vec3 &p = soup.points[t[0]], &q = soup.points[t[1]], &r = soup.points[t[2]];
    const double longest = std::max({distance(p, q), distance(q, r), distance(r, p)});
    return !(length(cross(q - p, r - p)) > 1e-9 * longest * longest);
  });
}

}  // namespace

Approximation approximate(const Shape& shape, double max_edge) {
  Approximation result;
  if (auto soup = shape.triangulate(max_edge)) {
    result.soup = std::move(*soup);
  } else {
    const auto* const selection = dynamic_cast<const FaceSelection*>(&shape);
    for (const int cells : {32, 64}) {
      Contouring grid(selection ? *selection->whole() : shape, cells);
      result.soup = grid.soup();
      result.lost = grid.coarse() ? grid.size() : 0;
      if (!grid.coarse()) break;
    }
    clean(result.soup);
    if (selection) select(*selection, result.soup);
  }
  result.deviation = deviation(shape, result.soup);
  return result;
}

}  // namespace isolux
