#include "isolux/formats/soup.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>

#include "isolux/core/error.h"
#include "isolux/formats/limits.h"
#include "isolux/geometry/ear_clipping.h"
#include "isolux/geometry/require.h"
#include "isolux/geometry/tessellation.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux {
namespace {

constexpr double kSamePlace = 1e-7;         // of the soup's size
constexpr double kLeastArea = 2e-12;        // of a triangle, of its size squared
constexpr std::size_t kMostClipped = 1000;  // corners; ear clipping takes their square
constexpr std::uint32_t kNone = 0xffffffffu;

using Corners = std::array<std::uint32_t, 3>;

/// Points by their place, those within `reach` (m) of one another being one.
class Places {
 public:
  Places(const std::vector<Vec3>& points, const Vec3& lower, double reach)
      : points_(points), lower_(lower), reach_(reach) {}

  /// The first point that is at the place of `number`; itself where there is none.
  std::uint32_t first_at(std::uint32_t number) {
    const Vec3& p = points_[number];
    std::array<std::array<std::int64_t, 2>, 3> cells;
    for (int axis = 0; axis < 3; ++axis) {
      cells[axis] = {cell(p[axis] - reach_, axis), cell(p[axis] + reach_, axis)};
    }
    for (std::int64_t x = cells[0][0]; x <= cells[0][1]; ++x) {
      for (std::int64_t y = cells[1][0]; y <= cells[1][1]; ++y) {
        for (std::int64_t z = cells[2][0]; z <= cells[2][1]; ++z) {
          const auto found = heads_.find(hash(x, y, z));
          for (std::uint32_t i = found == heads_.end() ? kNone : found->second; i != kNone;
               i = next_.at(i)) {
            if (distance(points_[i], p) <= reach_) return i;
          }
        }
      }
    }
    std::uint32_t& head =
        heads_.try_emplace(hash(cell(p.x, 0), cell(p.y, 1), cell(p.z, 2)), kNone).first->second;
    next_.emplace(number, head);
    head = number;
    return number;
  }

 private:
  std::int64_t cell(double x, int axis) const {
    constexpr double kCell = 4;  // in reaches
    return reach_ > 0 ? static_cast<std::int64_t>(std::floor((x - lower_[axis]) / (kCell * reach_)))
                      : 0;
  }
  static std::uint64_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto mix = [](std::uint64_t h, std::int64_t v) {
      return (h ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u + (h >> 29);
    };
    return mix(mix(mix(0, x), y), z);
  }

  const std::vector<Vec3>& points_;
  Vec3 lower_;
  double reach_;
  std::unordered_map<std::uint64_t, std::uint32_t> heads_;
  std::unordered_map<std::uint32_t, std::uint32_t> next_;
};

bool has_area(const TriangleSoup& soup, const Corners& t) {
  const Vec3 &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
  Bounds box;
  for (const Vec3& p : {a, b, c}) box.include(p);
  const double size = box.diagonal();
  return size > 2 * kShortestLength && length(cross(b - a, c - a)) > kLeastArea * size * size;
}

Vec3 newell(const std::vector<Vec3>& corners) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return sum;
}

std::vector<Corners> fan(std::size_t corners) {
  std::vector<Corners> triangles;
  for (std::uint32_t i = 1; i + 1 < corners; ++i) triangles.push_back({0, i, i + 1});
  return triangles;
}

/// Triangles between the corners, numbered from 0; nothing where ear clipping finds none.
std::optional<std::vector<Corners>> cut(const std::vector<Vec3>& corners) {
  const Vec3 normal = normalized(newell(corners));
  if (corners.size() > kMostClipped || !(length(normal) > 0)) return std::nullopt;
  if (corners.size() == 4) {
    const auto turn = [&](int a, int b, int c) {
      return dot(cross(corners[b] - corners[a], corners[c] - corners[a]), normal);
    };
    const bool first = turn(0, 1, 2) > 0 && turn(0, 2, 3) > 0;
    const bool second = turn(1, 2, 3) > 0 && turn(1, 3, 0) > 0;
    const bool shorter = distance(corners[0], corners[2]) <= distance(corners[1], corners[3]);
    if (first && (shorter || !second)) return std::vector<Corners>{{0, 1, 2}, {0, 2, 3}};
    if (second) return std::vector<Corners>{{1, 2, 3}, {1, 3, 0}};
  }
  const Frame frame(normal);
  Flat flat;
  Bounds box;
  for (const Vec3& p : corners) {
    box.include(p);
    flat.push_back({dot(p - corners[0], frame.u), dot(p - corners[0], frame.v), 0});
  }
  Ring ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0u);
  try {
    return clip_ears(flat, {ring}, 1e-12 * box.diagonal());
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// A side of a triangle, its ends in ascending order.
struct Side {
  std::uint32_t low, high, triangle;
  bool upward;
};

/// For each triangle its neighbours across edges of two triangles, and whether they run along the
/// edge in opposite directions.
struct Neighbours {
  std::vector<std::vector<std::pair<std::uint32_t, bool>>> of;
  std::vector<bool> open;  ///< whether a side of the triangle has no such neighbour

  explicit Neighbours(const TriangleSoup& soup)
      : of(soup.triangles.size()), open(soup.triangles.size(), false) {
    std::vector<Side> sides;
    for (std::uint32_t i = 0; i < soup.triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = soup.triangles[i][k], b = soup.triangles[i][(k + 1) % 3];
        sides.push_back({std::min(a, b), std::max(a, b), i, a < b});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    for (std::size_t i = 0, next = 0; i < sides.size(); i = next) {
      for (next = i + 1; next < sides.size() && sides[next].low == sides[i].low &&
                         sides[next].high == sides[i].high;) {
        ++next;
      }
      const Side &a = sides[i], &b = sides[next - 1];
      if (next - i != 2) {
        for (std::size_t k = i; k < next; ++k) open[sides[k].triangle] = true;
        continue;
      }
      of[a.triangle].emplace_back(b.triangle, a.upward != b.upward);
      of[b.triangle].emplace_back(a.triangle, a.upward != b.upward);
    }
  }
};

}  // namespace

void add_polygon(TriangleSoup& soup, const std::vector<std::uint32_t>& corners, Cutting& cutting) {
  if (corners.size() < 3) return;
  if (corners.size() == 3) {
    soup.triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const auto count = static_cast<double>(corners.size());
  if (count > 4) cutting.corner_pairs += count * count;
  if (cutting.corner_pairs > kMostCornerPairs) {
    throw InputError("the faces have too many corners; cut them into smaller ones");
  }
  std::vector<Vec3> points;
  for (const std::uint32_t corner : corners) points.push_back(soup.points[corner]);
  std::optional<std::vector<Corners>> triangles = cut(points);
  cutting.uncertain += !triangles;
  if (!triangles) triangles = fan(points.size());
  for (const auto& [a, b, c] : *triangles) {
    soup.triangles.push_back({corners[a], corners[b], corners[c]});
  }
}

LeftOut weld(TriangleSoup& soup) {
  Bounds box;
  for (const auto& t : soup.triangles) {
    for (const std::uint32_t corner : t) box.include(soup.points[corner]);
  }
  Places places(soup.points, box.lower, kSamePlace * box.diagonal());
  std::vector<std::uint32_t> first(soup.points.size(), kNone);
  LeftOut left_out;
  std::vector<Corners> kept;
  std::set<Corners> seen;
  for (Corners t : soup.triangles) {
    for (std::uint32_t& corner : t) {
      if (first[corner] == kNone) first[corner] = places.first_at(corner);
      corner = first[corner];
    }
    if (!has_area(soup, t)) {
      ++left_out.flat;
      continue;
    }
    Corners sorted = t;
    std::sort(sorted.begin(), sorted.end());
    if (seen.insert(sorted).second) {
      kept.push_back(t);
    } else {
      ++left_out.repeated;
    }
  }
  std::vector<std::uint32_t> number(soup.points.size(), kNone);
  std::vector<Vec3> points;
  for (Corners& t : kept) {
    for (std::uint32_t& corner : t) {
      if (number[corner] == kNone) {
        number[corner] = static_cast<std::uint32_t>(points.size());
        points.push_back(soup.points[corner]);
      }
      corner = number[corner];
    }
  }
  soup = {std::move(points), std::move(kept)};
  return left_out;
}

void agree(TriangleSoup& soup) {
  const Neighbours neighbours(soup);
  std::vector<char> turned(soup.triangles.size(), -1);  // -1: not met yet
  for (std::uint32_t start = 0; start < soup.triangles.size(); ++start) {
    if (turned[start] != -1) continue;
    std::vector<std::uint32_t> piece{start};
    turned[start] = 0;
    bool agreed = true, closed = true;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      closed = closed && !neighbours.of[piece[i]].empty() && !neighbours.open[piece[i]];
      for (const auto& [other, opposite] : neighbours.of[piece[i]]) {
        agreed = agreed && opposite;
        if (turned[other] != -1) continue;
        turned[other] = opposite ? turned[piece[i]] : !turned[piece[i]];
        piece.push_back(other);
      }
    }
    if (agreed) continue;
    double volume = 0;
    const Vec3 origin = soup.points[soup.triangles[start][0]];
    for (const std::uint32_t i : piece) {
      auto& t = soup.triangles[i];
      if (turned[i] == 1) std::swap(t[1], t[2]);
      volume += dot(soup.points[t[0]] - origin,
                    cross(soup.points[t[1]] - origin, soup.points[t[2]] - origin));
    }
    if (!closed || volume > 0) continue;
    for (const std::uint32_t i : piece) std::swap(soup.triangles[i][1], soup.triangles[i][2]);
  }
}

std::shared_ptr<const Shape> mesh_of(TriangleSoup soup, bool two_sided) {
  for (const Vec3& p : soup.points) {
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kFarthest) continue;
    throw InputError(fmt::format("a point lies more than {:g} m away", kFarthest));
  }
  if (two_sided) agree(soup);
  auto mesh = std::make_shared<TriangleMesh>(soup.points, soup.triangles);
  if (two_sided && mesh->unbounded()) {
    flip(soup);
    mesh = std::make_shared<TriangleMesh>(std::move(soup.points), std::move(soup.triangles));
  }
  return mesh;
}

}  // namespace isolux
