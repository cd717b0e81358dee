#include "isolux/discretization/mesh_lookup.h"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

#include "isolux/core/parallel.h"
#include "isolux/discretization/nearest_vertices.h"
#include "isolux/discretization/surface_walk.h"

namespace isolux {
namespace {

// How far outside its sides a triangle still counts, in parts of its height: over a convex edge of
// the mesh the feet of two neighbours' perpendiculars leave a narrow wedge open.
constexpr float kOutside = 0.05f;
// What the whole reach of a triangle counts in the same measure.
constexpr float kHeight = 0.1f * kOutside;
// Over a triangle this near, in parts of its reach, no other need be looked at: one of any object,
// and one of the object that the point is on, which hardly has another sheet so close by.
constexpr float kSure = 0.1f, kOwnSure = 0.5f;
// A vertex is covered if something lies over it nearer than this part of a side of its triangles.
constexpr double kCovered = 0.25;
// The cosine of the largest angle between a triangle and the surface that it stands for.
constexpr float kFacing = 0.5f;

/// In single precision, which is enough for a place in a triangle: coordinates count from the
/// middle of the mesh.
struct Vec3f {
  float x, y, z;
};

Vec3f narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
Vec3f operator-(const Vec3f& a, const Vec3f& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
float dot(const Vec3f& a, const Vec3f& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// All of a triangle, in one line of the cache: with d = p − corner, the weights of the second and
/// third vertex are along[0]·d and along[1]·d, and the height over it is up·d, in parts of how far
/// the surface may stand off it.
struct alignas(64) Facet {
  Vec3f corner;
  std::array<Vec3f, 2> along;
  Vec3f up;
  std::uint32_t object;
  std::array<VertexId, 3> vertices;
};
static_assert(sizeof(Facet) == 64);

/// A voxel of one of the grids, packed: 20 bits for each coordinate, which wrap around (far voxels
/// then share a list, which costs time only), and the grid's number.
using VoxelKey = std::uint64_t;

VoxelKey voxel_key(int level, std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t kMask = (1u << 20) - 1;
  return (static_cast<std::uint64_t>(level) << 60) |
         ((static_cast<std::uint64_t>(x) & kMask) << 40) |
         ((static_cast<std::uint64_t>(y) & kMask) << 20) | (static_cast<std::uint64_t>(z) & kMask);
}

std::size_t hash(VoxelKey key) {
  key *= 0x9e3779b97f4a7c15u;
  return static_cast<std::size_t>(key ^ (key >> 29));
}

}  // namespace

class MeshLookup::Impl {
 public:
  Impl(const Triangulation& mesh, const RayCaster* rays) : mesh_(mesh), nearest_(mesh) {
    find_middle();
    collect_triangles();
    if (!rays) return;
    walk_.emplace(*rays, mesh.rules().normal_tolerance);
    find_covered();
  }

  std::optional<MeshPlace> covering(const Vec3& point, const Vec3& normal) const {
    Search search(point - middle_, normal);
    for (int level = 0; level < levels_ && !search.sure; ++level) {
      look_among(find(voxel_of(search.from_middle, level)), search);
    }
    return doubtful(search) ? seen(point, normal) : search.place();
  }

  void covering(std::span<const std::optional<SurfaceHit>> hits,
                std::span<std::optional<MeshPlace>> places) const {
    constexpr std::size_t kTogether = 16;
    thread_local std::vector<Search> searches;
    for (std::size_t first = 0; first < hits.size(); first += kTogether) {
      const std::size_t end = std::min(first + kTogether, hits.size());
      searches.clear();
      for (std::size_t i = first; i < end; ++i) {
        if (!hits[i]) continue;
        const std::uint32_t object = hits[i]->surface.object;
        const GridSet grids = object < grids_.size() ? grids_[object] : GridSet{};
        searches.emplace_back(hits[i]->point - middle_, hits[i]->normal, object, grids);
      }
      look_together(searches);
      auto search = searches.begin();
      for (std::size_t i = first; i < end; ++i) {
        places[i].reset();
        if (!hits[i]) continue;
        places[i] = !search->best || doubtful(*search) ? covering(hits[i]->point, hits[i]->normal)
                                                       : search->place();
        ++search;
      }
    }
  }

  std::optional<MeshPlace> nearest(const Vec3& point, const Vec3& normal) const {
    if (walk_) {
      const SurfacePoint from = surface_point(point, normal);
      const auto found = nearest_.place(point, normal, [&](VertexId v) { return sees(from, v); });
      if (found) return found;
    }
    return nearest_.place(point, normal);
  }

 private:
  /// Grids, by bits.
  using GridSet = std::uint16_t;
  static constexpr GridSet kAll = 0xffff;
  static constexpr std::uint32_t kAny = ~0u;  // stands for all objects

  /// The best facet so far over a point, counted from the middle of the mesh.
  struct Search {
    Search(const Vec3& point, const Vec3& facing, std::uint32_t on = kAny, GridSet among = kAll)
        : from_middle(point), p(narrow(point)), n(narrow(facing)), object(on), grids(among) {}

    Vec3 from_middle;
    Vec3f p, n;
    std::uint32_t object;                        // whose facets count
    GridSet grids;                               // where they are
    VoxelKey key = 0;                            // of the voxel to look into next,
    std::span<const std::uint32_t> listed = {};  // and its facets
    const Facet* best = nullptr;
    float score = kOutside;
    std::array<float, 3> weights = {};
    bool sure = false;

    bool open(int level) const { return !sure && (grids >> level & 1); }
    std::optional<MeshPlace> place() const {
      if (!best) return std::nullopt;
      return place_in(*best, weights);
    }
  };

  static MeshPlace place_in(const Facet& facet, const std::array<float, 3>& weights) {
    MeshPlace place{facet.vertices, {}};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += place.weights[k] = std::max(static_cast<double>(weights[k]), 0.0);
    }
    for (double& w : place.weights) w /= sum;
    return place;
  }

  /// A facet over a point.
  struct Over {
    float score;  // the less, the nearer
    std::uint32_t facet;
    std::array<float, 3> weights;
    bool inside;  // all sides
    auto operator<=>(const Over& other) const {
      return std::pair(score, facet) <=> std::pair(other.score, other.facet);
    }
  };

  static std::optional<Over> over(const Facet& facet, std::uint32_t index, const Vec3f& p,
                                  const Vec3f& n) {
    const Vec3f d = p - facet.corner;
    const float w1 = dot(facet.along[0], d), w2 = dot(facet.along[1], d);
    const float outside = std::max({-w1, -w2, w1 + w2 - 1});
    if (outside > kOutside) return std::nullopt;
    const float height = std::abs(dot(facet.up, d)), facing = dot(facet.up, n);
    if (height > 1) return std::nullopt;
    if (facing < 0 || facing * facing < kFacing * kFacing * dot(facet.up, facet.up)) {
      return std::nullopt;
    }
    return Over{
        std::max(outside, 0.0f) + height * kHeight, index, {1 - w1 - w2, w1, w2}, outside <= 0};
  }

  static SurfacePoint surface_point(const Vec3& point, const Vec3& normal) {
    SurfacePoint from;
    from.position = point, from.normal = normal;
    return from;
  }

  /// Whether a vertex has the light that is there beside the point.
  bool sees(const SurfacePoint& from, VertexId v) const {
    return mesh_.vertex(v).hidden || walk_->open(from, mesh_.vertex(v));
  }

  /// Whether another triangle may have the light of the point.
  bool doubtful(const Search& search) const {
    return walk_ && search.best && covered_[static_cast<std::size_t>(search.best - facets_.data())];
  }

  /// The place among those vertices that the point sees: of a triangle all of which it sees, else
  /// in the part of one.
  std::optional<MeshPlace> seen(const Vec3& point, const Vec3& normal) const {
    constexpr double kLittle = 1e-3, kEnough = 0.5;  // of the weights
    const Vec3f p = narrow(point - middle_), n = narrow(normal);
    thread_local std::vector<Over> candidates;
    candidates.clear();
    for (int level = 0; level < levels_; ++level) {
      for (const std::uint32_t index : find(voxel_of(point - middle_, level))) {
        if (const auto found = over(facets_[index], index, p, n)) candidates.push_back(*found);
      }
    }
    std::sort(candidates.begin(), candidates.end());
    const SurfacePoint from = surface_point(point, normal);
    std::optional<MeshPlace> best;
    double most = kEnough;
    for (const Over& candidate : candidates) {
      MeshPlace place = place_in(facets_[candidate.facet], candidate.weights);
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        double& w = place.weights[k];
        if (w < kLittle || !sees(from, place.vertices[k])) w = 0;
        sum += w;
      }
      if (sum <= most) continue;
      most = sum;
      for (double& w : place.weights) w /= sum;
      best = place;
      if (sum > 1 - 3 * kLittle) break;
    }
    return best;
  }

  /// Of which facets vertices are covered.
  void find_covered() {
    std::vector<double> reach(mesh_.vertices().size());
    for (const Facet& facet : facets_) {
      double longest = 0;
      const auto at = [&](std::size_t k) { return mesh_.vertex(facet.vertices[k % 3]).position; };
      for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, distance(at(k), at(k + 1)));
      for (const VertexId v : facet.vertices) reach[v] = std::max(reach[v], kCovered * longest);
    }
    std::vector<char> covered(reach.size());
    const double near = 2 * walk_->rays().epsilon();
    parallel_for(reach.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const Vertex& vertex = mesh_.vertex(static_cast<VertexId>(v));
        covered[v] =
            reach[v] > near && walk_->rays().occluded({vertex.position + vertex.normal * near,
                                                       vertex.position + vertex.normal * reach[v]});
      }
    });
    for (const Facet& facet : facets_) {
      covered_.push_back(
          std::ranges::any_of(facet.vertices, [&](VertexId v) { return covered[v]; }));
    }
  }

  /// Grid by grid, so that all wait for memory together.
  void look_together(std::span<Search> searches) const {
    for (int level = 0; level < levels_; ++level) {
      const auto for_open = [&](const auto& act) {
        for (Search& search : searches) {
          if (search.open(level)) act(search);
        }
      };
      for_open([&](Search& search) {
        search.key = voxel_of(search.from_middle, level);
        __builtin_prefetch(&table_[hash(search.key) & (table_.size() - 1)]);
      });
      for_open([&](Search& search) {
        search.listed = find(search.key);
        __builtin_prefetch(search.listed.data());
      });
      for_open([&](const Search& search) {
        for (const std::uint32_t index : search.listed) __builtin_prefetch(&facets_[index]);
      });
      for_open([&](Search& search) { look_among(search.listed, search); });
    }
  }

  void look_among(std::span<const std::uint32_t> listed, Search& search) const {
    for (const std::uint32_t index : listed) {
      const Facet& facet = facets_[index];
      if (search.object != kAny && facet.object != search.object) continue;
      const std::optional<Over> found = over(facet, index, search.p, search.n);
      // The nearest sheet; in it the triangle whose sides are kept best.
      if (!found || (search.best && found->score >= search.score)) continue;
      search.best = &facet;
      search.score = found->score;
      search.weights = found->weights;
      const float sure = search.object == kAny ? kSure : kOwnSure;
      search.sure = found->inside && found->score < sure * kHeight;
      if (search.sure) return;
    }
  }

  /// The voxel of a coordinate counted in voxels, within 2⁴⁰ of them: the next lower whole number,
  /// but for rounding.
  static constexpr double kMiddleCell = 0x1p40 + 0x1p19;
  static std::int64_t cell(double coordinate) {
    return static_cast<std::int64_t>(coordinate + kMiddleCell);
  }
  VoxelKey voxel_of(const Vec3& from_middle, int level) const {
    const double scale = scales_[static_cast<std::size_t>(level)];
    return voxel_key(level, cell(from_middle.x * scale), cell(from_middle.y * scale),
                     cell(from_middle.z * scale));
  }

  void find_middle() {
    Bounds bounds;
    for (const Vertex& vertex : mesh_.vertices()) {
      if (!vertex.triangles.empty()) bounds.include(vertex.position);
    }
    if (!bounds.empty()) middle_ = bounds.center();
  }

  /// The living triangles, those of one voxel one after the other.
  void collect_triangles() {
    std::vector<TriangleId> living;
    for (TriangleId id = 0; id < mesh_.triangles().size(); ++id) {
      if (mesh_.triangle(id).alive && mesh_.triangle(id).area > 0) living.push_back(id);
    }
    const std::vector<int> levels = choose_grids(living);
    std::vector<std::tuple<VoxelKey, TriangleId, int>> order;
    for (std::size_t i = 0; i < living.size(); ++i) {
      order.emplace_back(voxel_of(box(living[i]).center(), levels[i]), living[i], levels[i]);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::pair<VoxelKey, std::uint32_t>> entries;
    facets_.reserve(order.size());
    for (const auto& [key, id, level] : order) {
      const auto index = static_cast<std::uint32_t>(facets_.size());
      facets_.push_back(facet_of(id));
      const std::uint32_t object = facets_.back().object;
      if (object >= grids_.size()) grids_.resize(object + 1);
      grids_[object] |= static_cast<GridSet>(1u << level);
      list(box(id), level, index, facets_.back(), entries);
    }
    fill_table(entries);
  }

  Facet facet_of(TriangleId id) const {
    const Triangle& triangle = mesh_.triangle(id);
    const Vec3 a = mesh_.vertex(triangle.vertices[0]).position;
    const Vec3 ab = mesh_.vertex(triangle.vertices[1]).position - a;
    const Vec3 ac = mesh_.vertex(triangle.vertices[2]).position - a;
    const Vec3 n = cross(ab, ac);
    const double squared = length_squared(n);
    return {narrow(a - middle_),
            {narrow(cross(ac, n) / squared), narrow(cross(n, ab) / squared)},
            narrow(triangle.normal / reach_of(id)),
            mesh_.vertex(triangle.vertices[0]).surface.object,
            triangle.vertices};
  }

  /// How far the true surface may stand off a triangle: thrice the rise of a circular arc over any
  /// side, and a little where it is flat.
  double reach_of(TriangleId id) const {
    const auto& corners = mesh_.triangle(id).vertices;
    double rise = 0, longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vertex& p = mesh_.vertex(corners[k]);
      const Vertex& q = mesh_.vertex(corners[(k + 1) % 3]);
      const Vec3 side = q.position - p.position;
      rise = std::max(rise, std::abs(dot(q.normal - p.normal, side)) / 8);
      longest = std::max(longest, length(side));
    }
    return 3 * rise + 0.01 * longest;
  }

  /// All places from which the triangle may be found, seen from the middle of the mesh: the
  /// triangle scaled about its own middle so that weights go down to −kOutside, and its reach.
  Bounds box(TriangleId id) const {
    const Triangle& triangle = mesh_.triangle(id);
    Vec3 center;
    for (const VertexId v : triangle.vertices) center += mesh_.vertex(v).position / 3;
    Bounds bounds;
    for (const VertexId v : triangle.vertices) {
      const Vec3 arm = mesh_.vertex(v).position - center;
      bounds.include(center + arm * (1 + 3.01 * kOutside) - middle_);
    }
    const double reach = 1.01 * reach_of(id);
    const Vec3& n = triangle.normal;
    const Vec3 room = Vec3{std::abs(n.x), std::abs(n.y), std::abs(n.z)} * reach;
    bounds.lower -= room;
    bounds.upper += room;
    return bounds;
  }

  /// The grid of each triangle, by the power of two of its size; voxels are a quarter to half as
  /// large as the triangles. At most kMostLevels grids: the finest takes all that is smaller.
  std::vector<int> choose_grids(std::span<const TriangleId> triangles) {
    constexpr int kMostLevels = 12;
    std::vector<int> exponents;
    for (const TriangleId id : triangles) exponents.push_back(std::ilogb(box(id).diagonal()));
    if (exponents.empty()) return {};
    const int largest = *std::max_element(exponents.begin(), exponents.end());
    std::array<int, kMostLevels> number;
    number.fill(-1);
    for (int& e : exponents) {
      e = std::min(largest - e, kMostLevels - 1);
      number[static_cast<std::size_t>(e)] = 0;
    }
    for (int k = 0; k < kMostLevels; ++k) {
      int& grid = number[static_cast<std::size_t>(k)];
      if (grid < 0) continue;
      grid = levels_++;
      scales_.push_back(1 / std::ldexp(0.5, largest - k));
    }
    for (int& e : exponents) e = number[static_cast<std::size_t>(e)];
    return exponents;
  }

  /// Lists a facet in the voxels from which it may be found: those that its box touches, but for
  /// such that lie wholly outside one of its sides, or beyond its reach.
  void list(const Bounds& box, int level, std::uint32_t index, const Facet& facet,
            std::vector<std::pair<VoxelKey, std::uint32_t>>& entries) const {
    constexpr double kRoom = 1.01;  // for rounding
    const double scale = scales_[static_cast<std::size_t>(level)];
    const auto wide = [](const Vec3f& v) { return Vec3{v.x, v.y, v.z}; };
    const Vec3 corner = wide(facet.corner), up = wide(facet.up);
    const Vec3 along1 = wide(facet.along[0]), along2 = wide(facet.along[1]);
    // How far what is linear may be off its value in the middle of a voxel.
    const auto spread = [&](const Vec3& gradient) {
      return 0.5 * kRoom / scale *
             (std::abs(gradient.x) + std::abs(gradient.y) + std::abs(gradient.z));
    };
    const double least1 = -kRoom * kOutside - spread(along1);
    const double least2 = -kRoom * kOutside - spread(along2);
    const double most12 = 1 + kRoom * kOutside + spread(along1 + along2);
    const double highest = kRoom + spread(up);
    const auto middle = [&](std::int64_t k) {
      return (static_cast<double>(k) + 0.5 - kMiddleCell) / scale;
    };
    for (auto z = cell(box.lower.z * scale); z <= cell(box.upper.z * scale); ++z) {
      for (auto y = cell(box.lower.y * scale); y <= cell(box.upper.y * scale); ++y) {
        for (auto x = cell(box.lower.x * scale); x <= cell(box.upper.x * scale); ++x) {
          const Vec3 d = Vec3{middle(x), middle(y), middle(z)} - corner;
          const double w1 = dot(along1, d), w2 = dot(along2, d);
          if (w1 < least1 || w2 < least2 || w1 + w2 > most12 || std::abs(dot(up, d)) > highest) {
            continue;
          }
          entries.emplace_back(voxel_key(level, x, y, z), index);
        }
      }
    }
  }

  /// Makes the table of entries whose facets ascend.
  void fill_table(std::span<const std::pair<VoxelKey, std::uint32_t>> entries) {
    // There are no more voxels than entries; as a rule a quarter of them.
    table_.assign(std::bit_ceil(entries.size() / 2 + 2), {});
    std::size_t voxels = 0;
    for (const auto& [key, facet] : entries) {
      if (4 * voxels >= 3 * table_.size()) grow_table();
      Voxel& voxel = table_[slot_of(key)];
      voxels += voxel.count++ == 0;
      voxel.key = key;
    }
    std::uint32_t end = 0;
    for (Voxel& voxel : table_) voxel.first = end, end += voxel.count;
    listed_.resize(entries.size());
    for (const auto& [key, facet] : entries) listed_[table_[slot_of(key)].first++] = facet;
    for (Voxel& voxel : table_) voxel.first -= voxel.count;
  }

  void grow_table() {
    const std::vector<Voxel> voxels = std::exchange(table_, std::vector<Voxel>(2 * table_.size()));
    for (const Voxel& voxel : voxels) {
      if (voxel.count > 0) table_[slot_of(voxel.key)] = voxel;
    }
  }

  /// Where the voxel stands in the table, or would.
  std::size_t slot_of(VoxelKey key) const {
    std::size_t slot = hash(key) & (table_.size() - 1);
    while (table_[slot].count > 0 && table_[slot].key != key) {
      slot = (slot + 1) & (table_.size() - 1);
    }
    return slot;
  }

  std::span<const std::uint32_t> find(VoxelKey key) const {
    const Voxel& voxel = table_[slot_of(key)];
    return std::span(listed_).subspan(voxel.first, voxel.count);
  }

  /// A slot of the hash table: a voxel and its part of `listed_`; free where count is 0.
  struct Voxel {
    VoxelKey key = 0;
    std::uint32_t first = 0, count = 0;
  };

  const Triangulation& mesh_;
  NearestVertices nearest_;
  std::optional<SurfaceWalk> walk_;
  std::vector<char> covered_;   // by facet: whether vertices of it are
  Vec3 middle_;                 // of the mesh
  int levels_ = 0;              // grids
  std::vector<double> scales_;  // by grid: voxels per m
  std::vector<GridSet> grids_;  // by object: those that its facets are in
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> listed_;  // facets, voxel by voxel
  std::vector<Voxel> table_;
};

MeshLookup::MeshLookup(const Triangulation& mesh, const RayCaster* rays)
    : impl_(std::make_unique<Impl>(mesh, rays)) {}
MeshLookup::~MeshLookup() = default;

std::optional<MeshPlace> MeshLookup::covering(const Vec3& point, const Vec3& normal) const {
  return impl_->covering(point, normal);
}

void MeshLookup::covering(std::span<const std::optional<SurfaceHit>> hits,
                          std::span<std::optional<MeshPlace>> places) const {
  impl_->covering(hits, places);
}

std::optional<MeshPlace> MeshLookup::nearest(const Vec3& point, const Vec3& normal) const {
  return impl_->nearest(point, normal);
}

std::optional<MeshPlace> MeshLookup::place(const Vec3& point, const Vec3& normal) const {
  if (auto found = covering(point, normal)) return found;
  return nearest(point, normal);
}

}  // namespace isolux
