#include "isolux/discretization/mesh_lookup.h"

#include <algorithm>
#include <bit>

namespace isolux {
namespace {

// How far outside its sides a triangle still counts, in parts of its height: over a convex edge of
// the mesh the feet of two neighbours' perpendiculars leave a narrow wedge open.
constexpr double kOutside = 0.05;
// What the whole reach of a triangle counts in the same measure, and what is so near that no other
// triangle need be looked at.
constexpr double kHeight = 0.1 * kOutside;
constexpr double kSure = 0.1 * kHeight;
// The cosine of the largest angle between a triangle and the surface that it stands for.
constexpr double kFacing = 0.5;

/// What a query needs of a triangle, in one line of the cache: with d = p − corner, the weights of
/// the second and third vertex are along[0]·d and along[1]·d, and the height over it is normal·d.
/// `reach` is how far the surface may stand off it, m.
struct alignas(64) Facet {
  Vec3 corner;
  std::array<std::array<float, 3>, 2> along;
  std::array<float, 3> normal;
  float reach;
};
static_assert(sizeof(Facet) == 64);

std::array<float, 3> narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

double dot(const std::array<float, 3>& a, const Vec3& b) {
  return double(a[0]) * b.x + double(a[1]) * b.y + double(a[2]) * b.z;
}

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
  explicit Impl(const Triangulation& mesh) : mesh_(mesh), near_(Vec3{}, mesh.rules().max_edge) {
    collect();
    choose_grids();
    fill_voxels();
  }

  std::optional<MeshPlace> covering(const Vec3& point, const Vec3& normal) const {
    const Facet* best = nullptr;
    std::array<double, 3> weights{};
    double best_score = kOutside;
    for (int level = 0; level < levels_; ++level) {
      const double scale = scales_[static_cast<std::size_t>(level)];
      const auto list = find(
          voxel_key(level, cell(point.x * scale), cell(point.y * scale), cell(point.z * scale)));
      for (const std::uint32_t index : list) {
        const Facet& facet = facets_[index];
        const Vec3 d = point - facet.corner;
        const double w1 = dot(facet.along[0], d), w2 = dot(facet.along[1], d);
        const double outside = std::max({-w1, -w2, w1 + w2 - 1});
        if (outside > kOutside || dot(facet.normal, normal) < kFacing) continue;
        const double height = std::abs(dot(facet.normal, d));
        if (height > facet.reach) continue;
        // The nearest sheet; in it the triangle whose sides are kept best.
        const double score = std::max(outside, 0.0) + height / facet.reach * kHeight;
        if (best && score >= best_score) continue;
        best = &facet;
        best_score = score;
        weights = {1 - w1 - w2, w1, w2};
        if (outside <= 0 && score < kSure) return place_in(best, weights);
      }
    }
    if (!best) return std::nullopt;
    return place_in(best, weights);
  }

  std::optional<MeshPlace> nearest_vertices(const Vec3& point, const Vec3& normal) const {
    for (const double facing : {kFacing, 1e-6}) {
      // Every vertex within the radius is looked at; a wider search can only add farther ones.
      double radius = mesh_.rules().max_edge;
      for (; radius < 8 * extent_ + 8 * mesh_.rules().max_edge; radius *= 2) {
        const auto found = nearest_vertices(point, normal, facing, radius);
        if (found) return found;
      }
    }
    return std::nullopt;
  }

 private:
  MeshPlace place_in(const Facet* facet, std::array<double, 3> weights) const {
    double sum = 0;
    for (double& w : weights) sum += w = std::max(w, 0.0);
    for (double& w : weights) w /= sum;
    return {corners_[static_cast<std::size_t>(facet - facets_.data())], weights};
  }

  /// The voxel of a coordinate counted in voxels: monotonic, and where it matters (within half a
  /// million voxels of the origin) that of the next lower whole number.
  static std::int64_t cell(double coordinate) {
    return static_cast<std::int64_t>(coordinate + 0x1p19);
  }

  std::optional<MeshPlace> nearest_vertices(const Vec3& point, const Vec3& normal, double facing,
                                            double radius) const {
    thread_local std::vector<std::uint32_t> ids;
    thread_local std::vector<std::pair<double, VertexId>> found;
    near_.query(point, radius, ids);
    found.clear();
    for (const VertexId v : ids) {
      const Vertex& vertex = mesh_.vertex(v);
      const double squared = length_squared(vertex.position - point);
      if (squared <= radius * radius && dot(vertex.normal, normal) >= facing) {
        found.emplace_back(squared, v);
      }
    }
    if (found.empty()) return std::nullopt;
    std::sort(found.begin(), found.end());
    MeshPlace place;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& [squared, v] = found[std::min(k, found.size() - 1)];
      place.vertices[k] = v;
      if (k < found.size()) sum += place.weights[k] = 1 / std::max(squared, 1e-200);
    }
    for (double& w : place.weights) w /= sum;
    return place;
  }

  /// The living triangles and their vertices.
  void collect() {
    for (TriangleId id = 0; id < mesh_.triangles().size(); ++id) {
      const Triangle& triangle = mesh_.triangle(id);
      if (!triangle.alive) continue;
      const Vertex& a = mesh_.vertex(triangle.vertices[0]);
      const Vertex& b = mesh_.vertex(triangle.vertices[1]);
      const Vertex& c = mesh_.vertex(triangle.vertices[2]);
      const Vec3 ab = b.position - a.position, ac = c.position - a.position;
      const Vec3 n = cross(ab, ac);
      const double squared = length_squared(n);
      if (!(squared > 0)) continue;
      facets_.push_back({a.position,
                         {narrow(cross(ac, n) / squared), narrow(cross(n, ab) / squared)},
                         narrow(triangle.normal),
                         static_cast<float>(reach_of({&a, &b, &c}))});
      corners_.push_back(triangle.vertices);
    }
    Bounds bounds;
    for (VertexId v = 0; v < mesh_.vertices().size(); ++v) {
      const Vertex& vertex = mesh_.vertex(v);
      if (vertex.triangles.empty()) continue;
      near_.insert(v, vertex.position);
      bounds.include(vertex.position);
    }
    extent_ = bounds.diagonal();
  }

  /// How far the true surface may stand off a triangle: thrice the rise of a circular arc over any
  /// side, and a little where it is flat.
  static double reach_of(const std::array<const Vertex*, 3>& corners) {
    double rise = 0, longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vertex &p = *corners[k], &q = *corners[(k + 1) % 3];
      const Vec3 side = q.position - p.position;
      rise = std::max(rise, std::abs(dot(q.normal - p.normal, side)) / 8);
      longest = std::max(longest, length(side));
    }
    return 3 * rise + 0.01 * longest;
  }

  Bounds box(std::size_t facet) const {
    Bounds bounds;
    for (const VertexId v : corners_[facet]) bounds.include(mesh_.vertex(v).position);
    const double room = facets_[facet].reach + kOutside * bounds.diagonal();
    bounds.lower -= Vec3{room, room, room};
    bounds.upper += Vec3{room, room, room};
    return bounds;
  }

  /// Triangles go by the power of two of their size; voxels are a quarter to half as large
  /// as they. At most kMostLevels grids: the finest takes all that is smaller.
  void choose_grids() {
    constexpr int kMostLevels = 12;
    std::vector<int> exponents;
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      exponents.push_back(std::ilogb(box(i).diagonal()));
    }
    level_of_.assign(facets_.size(), 0);
    if (exponents.empty()) return;
    const int largest = *std::max_element(exponents.begin(), exponents.end());
    std::array<bool, kMostLevels> used{};
    const auto below_largest = [&](int e) { return std::min(largest - e, kMostLevels - 1); };
    for (const int e : exponents) used[static_cast<std::size_t>(below_largest(e))] = true;
    std::array<int, kMostLevels> number{};
    for (int k = 0; k < kMostLevels; ++k) {
      if (!used[static_cast<std::size_t>(k)]) continue;
      number[static_cast<std::size_t>(k)] = levels_++;
      scales_.push_back(1 / std::ldexp(0.5, largest - k));
    }
    for (std::size_t i = 0; i < facets_.size(); ++i) {
      level_of_[i] =
          static_cast<std::uint8_t>(number[static_cast<std::size_t>(below_largest(exponents[i]))]);
    }
  }

  void fill_voxels() {
    std::vector<std::pair<VoxelKey, std::uint32_t>> entries;
    for (std::uint32_t i = 0; i < facets_.size(); ++i) {
      const Bounds b = box(i);
      const double scale = scales_[level_of_[i]];
      for (auto z = cell(b.lower.z * scale); z <= cell(b.upper.z * scale); ++z) {
        for (auto y = cell(b.lower.y * scale); y <= cell(b.upper.y * scale); ++y) {
          for (auto x = cell(b.lower.x * scale); x <= cell(b.upper.x * scale); ++x) {
            entries.emplace_back(voxel_key(level_of_[i], x, y, z), i);
          }
        }
      }
    }
    std::sort(entries.begin(), entries.end());
    for (const auto& [key, facet] : entries) listed_.push_back(facet);

    std::size_t voxels = 0;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      voxels += i == 0 || entries[i].first != entries[i - 1].first;
    }
    table_.assign(std::bit_ceil(2 * voxels + 2), {});
    for (std::size_t i = 0; i < entries.size();) {
      std::size_t end = i;
      while (end < entries.size() && entries[end].first == entries[i].first) ++end;
      std::size_t slot = hash(entries[i].first) & (table_.size() - 1);
      while (table_[slot].count > 0) slot = (slot + 1) & (table_.size() - 1);
      table_[slot] = {entries[i].first, static_cast<std::uint32_t>(i),
                      static_cast<std::uint32_t>(end - i)};
      i = end;
    }
  }

  std::span<const std::uint32_t> find(VoxelKey key) const {
    for (std::size_t slot = hash(key) & (table_.size() - 1); table_[slot].count > 0;
         slot = (slot + 1) & (table_.size() - 1)) {
      if (table_[slot].key == key) {
        return std::span(listed_).subspan(table_[slot].first, table_[slot].count);
      }
    }
    return {};
  }

  /// A slot of the hash table: a voxel and its part of `listed_`; free where count is 0.
  struct Voxel {
    VoxelKey key = 0;
    std::uint32_t first = 0, count = 0;
  };

  const Triangulation& mesh_;
  VertexGrid near_;             // the vertices of living triangles
  double extent_ = 0;           // of the mesh, m
  int levels_ = 0;              // grids
  std::vector<double> scales_;  // by grid: voxels per m
  std::vector<Facet> facets_;
  std::vector<std::array<VertexId, 3>> corners_;  // of the facets
  std::vector<std::uint8_t> level_of_;            // the facets' grids
  std::vector<std::uint32_t> listed_;             // facets, voxel by voxel
  std::vector<Voxel> table_;
};

MeshLookup::MeshLookup(const Triangulation& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
MeshLookup::~MeshLookup() = default;

std::optional<MeshPlace> MeshLookup::covering(const Vec3& point, const Vec3& normal) const {
  return impl_->covering(point, normal);
}

std::optional<MeshPlace> MeshLookup::place(const Vec3& point, const Vec3& normal) const {
  if (auto found = impl_->covering(point, normal)) return found;
  return impl_->nearest_vertices(point, normal);
}

}  // namespace isolux
