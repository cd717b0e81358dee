#include "isolux/inspection/contact.h"

#include <algorithm>
#include <array>
#include <map>

#include "isolux/core/parallel.h"
#include "isolux/core/random.h"
#include "isolux/sampling/lines.h"

namespace isolux {
namespace {

using Index = std::uint32_t;
using Points = std::vector<Hit>;

constexpr double kAlike = 0.9999;  // cosine between parallel normals
constexpr double kDeep = 1e-3;     // of the smaller object: inside a solid for sure
constexpr double kThrough = 5e-3;  // of a line in a face: what crosses the face does so by more
constexpr std::size_t kMostLooks = 16, kLeastLooks = 4;  // points of an object to look from
constexpr std::size_t kAllLooks = 400'000;               // about, in a scene of many objects
constexpr std::size_t kMostPairs = 4096;                 // that are looked at closely

/// All there is to know of one object by itself.
struct Look {
  std::map<Index, Index> covered;  // by which object, how many of its points
  std::vector<Index> inside;       // solids around some point of it
  std::vector<Index> crossing;
};

class Inspector {
 public:
  Inspector(const RayCaster& rays, std::span<const Points> points)
      : rays_(rays), objects_(rays.scene().objects), points_(points), near_(10 * rays.epsilon()) {
    for (Index i = 0; i < objects_.size(); ++i) {
      if (objects_[i].shape->unbounded()) endless_.push_back(i);
    }
  }

  Look look(Index i) const {
    Look look;
    Random random(4, i);
    for (const Hit& point : points_[i]) note_covers(i, point, look);
    const std::size_t share = kAllLooks / points_.size();
    const std::size_t n = std::min(std::clamp(share, kLeastLooks, kMostLooks), points_[i].size());
    for (std::size_t k = 0; k < n; ++k) {
      note_solids(i, points_[i][k], random, look.inside);
      note_crossings(i, points_[i][k], points_[i][random.below(points_[i].size())], look.crossing);
    }
    return look;
  }

  /// Whether some face of j lies on i, facing alike, with a part of it only.
  bool partly_upon(Index j, Index i) const {
    struct Count {
      Index on = 0, off = 0;
    };
    std::map<Index, Count> faces;
    for (const Hit& point : points_[j]) {
      Count& count = faces[point.face];
      ++(lies_on(point, i) ? count.on : count.off);
    }
    return std::any_of(faces.begin(), faces.end(),
                       [](const auto& face) { return face.second.on > 1 && face.second.off > 1; });
  }

  enum class Depth { outside, partly, inside };
  /// How much of i is inside the solid j, by more than a hair.
  Depth depth(Index i, Index j) const {
    const double margin = kDeep * std::min(objects_[i].shape->bounds().diagonal(),
                                           objects_[j].shape->bounds().diagonal());
    std::size_t within = 0, outside = 0;
    for (const Hit& point : points_[i]) {
      const int around = inside_around(j, point.point, margin);
      within += around == 6;
      outside += around == 0;
    }
    if (within == 0) return Depth::outside;
    return outside == 0 ? Depth::inside : Depth::partly;
  }

 private:
  /// Which objects, facing alike, cover the object at one of its points.
  void note_covers(Index i, const Hit& at, Look& look) const {
    thread_local std::vector<SurfaceHit> hits;
    rays_.all_hits({at.point + at.normal * near_, -at.normal}, {0, 2 * near_}, hits);
    for (const SurfaceHit& hit : hits) {
      const Index j = hit.surface.object;
      if (j == i || hit.back || dot(hit.normal, at.normal) < kAlike) continue;
      if (objects_[i].emits() != objects_[j].emits()) continue;
      ++look.covered[j];
    }
  }

  /// Whether i's own surface is at the point too, facing alike. Of shapes with many parts, only
  /// what no other object covers there.
  bool lies_on(const Hit& at, Index i) const {
    const auto alike = [&](const auto& hit) { return dot(hit.normal, at.normal) > kAlike; };
    if (few_parts(i)) {
      thread_local Hits hits;
      hits.clear();
      objects_[i].shape->intersect({at.point, at.normal}, hits);
      return std::any_of(hits.begin(), hits.end(),
                         [&](const Hit& hit) { return std::abs(hit.t) <= near_ && alike(hit); });
    }
    thread_local std::vector<SurfaceHit> hits;
    rays_.all_hits({at.point + at.normal * near_, -at.normal}, {0, 2 * near_}, hits);
    return std::any_of(hits.begin(), hits.end(), [&](const SurfaceHit& hit) {
      return hit.surface.object == i && alike(hit);
    });
  }

  /// Whether the point is inside the solid i. Of shapes with many parts, whether rays in opposite
  /// directions both begin inside.
  bool inside(Index i, const Vec3& point) const {
    const Shape& shape = *objects_[i].shape;
    if (few_parts(i)) return shape.contains(point);
    thread_local std::vector<SurfaceHit> hits;
    const Vec3 direction = normalized({0.31, 0.27, 0.91});  // any will do
    for (const Vec3& way : {direction, -direction}) {
      rays_.all_hits({point, way}, {}, hits);
      const auto first = std::find_if(
          hits.begin(), hits.end(), [&](const SurfaceHit& hit) { return hit.surface.object == i; });
      if (first == hits.end() ? !shape.unbounded() : dot(first->normal, way) < 0) return false;
    }
    return true;
  }

  /// Whether to ask the shape itself, which looks at all its parts.
  bool few_parts(Index i) const {
    constexpr std::size_t kFew = 64;
    return objects_[i].shape->part_count() <= kFew;
  }

  /// The solids that a ray from the point leaves before it enters them.
  void note_solids(Index i, const Hit& at, Random& random, std::vector<Index>& solids) const {
    thread_local std::vector<SurfaceHit> hits;
    thread_local std::vector<Index> met;
    const Vec3 direction = random_line({}, 1, random).direction;
    rays_.all_hits({at.point, direction}, {near_, std::numeric_limits<double>::infinity()}, hits);
    met.assign(1, i);
    for (const SurfaceHit& hit : hits) {
      const Index j = hit.surface.object;
      if (std::find(met.begin(), met.end(), j) != met.end()) continue;
      met.push_back(j);
      if (objects_[j].shape->solid() && dot(hit.normal, direction) > 0) solids.push_back(j);
    }
    for (const Index j : endless_) {
      if (j != i && inside(j, at.point)) solids.push_back(j);
    }
  }

  /// What stands across the line between two points of a flat face, on both sides of the face.
  void note_crossings(Index i, const Hit& a, const Hit& b, std::vector<Index>& crossing) const {
    const Vec3 way = b.point - a.point;
    const double along = length(way), lift = kThrough * along;
    if (a.face != b.face || dot(a.normal, b.normal) < 1 - 1e-12) return;
    if (!(lift > near_) || std::abs(dot(way, a.normal)) > 1e-9 * along) return;
    std::array<std::vector<SurfaceHit>, 3> hits;  // under, in and over the face
    for (std::size_t k = 0; k < hits.size(); ++k) {
      const Vec3 from = a.point + a.normal * (lift * (double(k) - 1));
      rays_.all_hits({from, way}, {0, 1}, hits[k]);
    }
    for (const SurfaceHit& hit : hits[1]) {
      const auto goes_on = [&](const std::vector<SurfaceHit>& beside) {
        return std::any_of(beside.begin(), beside.end(), [&](const SurfaceHit& other) {
          return other.surface == hit.surface && std::abs(other.t - hit.t) < 2 * kThrough;
        });
      };
      if (hit.surface.object == i || !goes_on(hits[0]) || !goes_on(hits[2])) continue;
      // Where there is a hole in the face, or its outline bends inwards, nothing is crossed.
      if (lies_on({0, hit.point, a.normal, a.face}, i)) crossing.push_back(hit.surface.object);
    }
  }

  /// Around the point in all six directions, how many places are inside the solid i.
  int inside_around(Index i, const Vec3& point, double distance) const {
    int count = 0;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      count += inside(i, point + axis * distance);
      count += inside(i, point - axis * distance);
    }
    return count;
  }

  const RayCaster& rays_;
  const std::vector<Object>& objects_;
  std::span<const Points> points_;
  double near_;                 // m: closer than this is the same place
  std::vector<Index> endless_;  // solids without bounds, such as rooms seen from inside
};

void sort_out(std::vector<ObjectPair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

ObjectPair in_order(Index i, Index j) { return {std::min(i, j), std::max(i, j)}; }

}  // namespace

Contacts find_contacts(const RayCaster& rays, std::span<const Points> points) {
  const Inspector inspector(rays, points);
  std::vector<Look> looks(points.size());
  parallel_for(looks.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) looks[i] = inspector.look(static_cast<Index>(i));
  });

  Contacts contacts;
  std::vector<ObjectPair> alike, within;
  for (Index i = 0; i < looks.size(); ++i) {
    for (const auto& [j, count] : looks[i].covered) {
      const bool hidden = i < j && count == points[i].size();
      if (hidden) contacts.hidden.push_back({i, j});
      if (!hidden) alike.push_back(in_order(i, j));
    }
    for (const Index j : looks[i].inside) within.push_back({i, j});
    for (const Index j : looks[i].crossing) contacts.crossing.push_back(in_order(i, j));
  }
  sort_out(alike);
  sort_out(within);
  for (std::vector<ObjectPair>* pairs : {&alike, &within}) {
    if (pairs->size() > kMostPairs) pairs->resize(kMostPairs);
  }
  for (const auto& [i, j] : alike) {
    if (inspector.partly_upon(j, i)) contacts.overlapping.push_back({i, j});
  }
  for (const auto& [i, j] : within) {
    const auto depth = inspector.depth(i, j);
    if (depth == Inspector::Depth::inside) contacts.buried.push_back({i, j});
    if (depth == Inspector::Depth::partly) contacts.crossing.push_back(in_order(i, j));
  }
  sort_out(contacts.crossing);
  return contacts;
}

}  // namespace isolux
