#include "isolux/discretization/connect.h"

#include "isolux/core/parallel.h"

namespace isolux {
namespace {

constexpr std::size_t kGrain = 32;
// Stars look this many sizes far; triangles have circles of less than this radius, in sizes.
constexpr double kReach = 3.5;
constexpr double kLargestCircle = 2.5;
// Segments between points on creases are looked at this much inside, in their lengths: more than
// the bulge of a crease between two points.
constexpr double kPull = 0.1;

struct Flat {
  double x, y;
};

/// The Voronoi cell of the plane's origin: a convex polygon whose side k, from corner k to the
/// next, it owes to a neighbour.
class Cell {
 public:
  static constexpr int kNobody = -1;

  explicit Cell(double half_side) {
    const double r = half_side;
    corners_ = {{-r, -r}, {r, -r}, {r, r}, {-r, r}};
    owners_.assign(4, kNobody);
  }

  double radius_squared() const {
    double most = 0;
    for (const Flat& c : corners_) most = std::max(most, c.x * c.x + c.y * c.y);
    return most;
  }

  bool cut_by(const Flat& q) const {
    const double half = 0.5 * (q.x * q.x + q.y * q.y);
    return std::any_of(corners_.begin(), corners_.end(),
                       [&](const Flat& c) { return c.x * q.x + c.y * q.y > half; });
  }

  void cut(const Flat& q, int owner) {
    const double half = 0.5 * (q.x * q.x + q.y * q.y);
    const std::size_t n = corners_.size();
    std::vector<Flat> corners;
    std::vector<int> owners;
    for (std::size_t i = 0; i < n; ++i) {
      const Flat &a = corners_[i], &b = corners_[(i + 1) % n];
      const double da = half - (a.x * q.x + a.y * q.y), db = half - (b.x * q.x + b.y * q.y);
      if (da >= 0) corners.push_back(a), owners.push_back(owners_[i]);
      if ((da >= 0) == (db >= 0)) continue;
      const double t = da / (da - db);
      corners.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
      owners.push_back(da >= 0 ? owner : owners_[i]);
    }
    corners_ = std::move(corners), owners_ = std::move(owners);
  }

  const std::vector<int>& owners() const { return owners_; }

 private:
  std::vector<Flat> corners_;
  std::vector<int> owners_;
};

struct Candidate {
  double squared;
  std::uint32_t id;
  Flat at;
};

std::vector<StarTriangle> star_of(const CoverPoints& all, std::uint32_t id, const SurfaceWalk& walk,
                                  double longest) {
  const CoverPoint& p = all.points()[id];
  const Frame frame(p.normal);
  thread_local std::vector<std::uint32_t> ids;
  const double reach = std::min(kReach * p.longest(), longest);
  all.grid().query(p.surface.object, p.position, reach, 4, ids);
  std::vector<Candidate> around;
  for (const std::uint32_t other : ids) {
    const CoverPoint& q = all.points()[other];
    const Vec3 d = q.position - p.position;
    if (other == id || length_squared(d) > reach * reach ||
        dot(p.normal, q.normal) < walk.cos_normal_tolerance()) {
      continue;
    }
    // Laid out at its true distance, as if the surface were rolled flat, and squeezed.
    const Vec3 flat = p.squeezed(d);
    const double squared = length_squared(flat), x = dot(flat, frame.u), y = dot(flat, frame.v);
    const double scale = std::sqrt(squared / std::max(x * x + y * y, 1e-300));
    if (scale > 1.5 || squared > kReach * kReach * p.size * p.size) continue;
    around.push_back({squared, other, {x * scale, y * scale}});
  }
  std::sort(around.begin(), around.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.squared, a.id) < std::tie(b.squared, b.id);
  });

  Cell cell(kLargestCircle * p.size);
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (around[i].squared > 4 * cell.radius_squared()) break;
    if (!cell.cut_by(around[i].at)) continue;
    const CoverPoint& q = all.points()[around[i].id];
    const bool first = id < around[i].id;
    if (linked(first ? p : q, first ? q : p, walk)) cell.cut(around[i].at, static_cast<int>(i));
  }

  std::vector<StarTriangle> star;
  const std::vector<int>& owners = cell.owners();
  for (std::size_t k = 0; k < owners.size(); ++k) {
    const int i = owners[k], j = owners[(k + 1) % owners.size()];
    if (i == Cell::kNobody || j == Cell::kNobody) continue;
    std::array<std::uint32_t, 3> corners{id, around[i].id, around[j].id};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    star.push_back({corners, 1});
  }
  return star;
}

}  // namespace

bool linked(const CoverPoint& a, const CoverPoint& b, const SurfaceWalk& walk) {
  if (a.reflectance != b.reflectance || a.emission != b.emission) return false;
  const double pull = kPull * distance(a.position, b.position);
  const auto pulled = [&](const CoverPoint& p) -> std::optional<ZonePoint> {
    return p.on_crease() ? walk.over(p, p.position + p.inward * pull) : p;
  };
  const std::optional<ZonePoint> from = pulled(a), to = pulled(b);
  if (!from || !to || !walk.open(*from, *to)) return false;
  const auto there = walk.over(*from, to->position);
  if (!there || distance(there->position, to->position) > 0.02 * pull / kPull) return false;
  return walk.over(*from, (from->position + to->position) * 0.5).has_value();
}

std::vector<StarTriangle> star_triangles(const CoverPoints& points, const SurfaceWalk& walk,
                                         double longest) {
  const std::size_t n = points.points().size();
  std::vector<std::vector<StarTriangle>> stars(n);
  parallel_for(n, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      stars[i] = star_of(points, static_cast<std::uint32_t>(i), walk, longest);
    }
  });

  std::vector<StarTriangle> all;
  for (const auto& star : stars) all.insert(all.end(), star.begin(), star.end());
  std::sort(all.begin(), all.end(),
            [](const StarTriangle& a, const StarTriangle& b) { return a.corners < b.corners; });
  std::vector<StarTriangle> voted;
  for (const StarTriangle& t : all) {
    if (!voted.empty() && voted.back().corners == t.corners) {
      ++voted.back().votes;
    } else {
      voted.push_back(t);
    }
  }
  std::stable_sort(voted.begin(), voted.end(),
                   [](const StarTriangle& a, const StarTriangle& b) { return a.votes > b.votes; });
  return voted;
}

}  // namespace isolux
