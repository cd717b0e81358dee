#include "isolux/discretization/mesh_lookup.h"

namespace isolux {
namespace {

// Over a triangle this near, in parts of its reach, no other need be looked at: one of any object,
// and one of the object that the point is on, which hardly has another sheet so close by.
constexpr float kSure = 0.1f, kOwnSure = 0.5f;
constexpr std::uint32_t kAny = ~0u;  // stands for all objects

SurfacePoint surface_point(const Vec3& point, const Vec3& normal) {
  SurfacePoint from;
  from.position = point, from.normal = normal;
  return from;
}

}  // namespace

/// The best facet so far over a point, counted from the middle of the mesh.
struct MeshLookup::Search {
  Search(const Vec3& point, const Vec3& facing, std::uint32_t on = kAny,
         FacetGrids::GridSet among = FacetGrids::kAll)
      : from_middle(point), p(narrow(point)), n(narrow(facing)), object(on), grids(among) {}

  Vec3 from_middle;
  Vec3f p, n;
  std::uint32_t object;                        // whose facets count
  FacetGrids::GridSet grids;                   // where they are
  VoxelKey key = 0;                            // of the voxel to look into next,
  std::span<const std::uint32_t> listed = {};  // and its facets
  const Facet* best = nullptr;
  float score = Facet::kOutside;
  std::array<float, 3> weights = {};
  bool sure = false;

  bool open(int grid) const { return !sure && (grids >> grid & 1); }
  std::optional<MeshPlace> place() const {
    if (!best) return std::nullopt;
    return place_in(*best, weights);
  }
};

MeshLookup::MeshLookup(const Triangulation& mesh, const RayCaster* rays)
    : grids_(mesh), nearest_(mesh) {
  if (rays) sight_.emplace(mesh, grids_, *rays);
}

std::optional<MeshPlace> MeshLookup::covering(const Vec3& point, const Vec3& normal) const {
  Search search(point - grids_.middle(), normal);
  for (int grid = 0; grid < grids_.count() && !search.sure; ++grid) {
    look_among(grids_.voxels().find(grids_.voxel_of(search.from_middle, grid)), search);
  }
  const SurfacePoint from = surface_point(point, normal);
  const bool doubt =
      doubtful(search) || (sight_ && search.best && !sight_->in_sheet(from, *search.best));
  return doubt ? sight_->place(from) : search.place();
}

void MeshLookup::covering(std::span<const std::optional<SurfaceHit>> hits,
                          std::span<std::optional<MeshPlace>> places) const {
  constexpr std::size_t kTogether = 16;
  thread_local std::vector<Search> searches;
  for (std::size_t first = 0; first < hits.size(); first += kTogether) {
    const std::size_t end = std::min(first + kTogether, hits.size());
    searches.clear();
    for (std::size_t i = first; i < end; ++i) {
      if (!hits[i]) continue;
      const std::uint32_t object = hits[i]->surface.object;
      searches.emplace_back(hits[i]->point - grids_.middle(), hits[i]->normal, object,
                            grids_.of_object(object));
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

std::optional<MeshPlace> MeshLookup::nearest(const Vec3& point, const Vec3& normal) const {
  if (sight_) {
    const SurfacePoint from = surface_point(point, normal);
    const auto sees = [&](VertexId v) { return sight_->sees(from, v); };
    if (const auto found = nearest_.place(point, normal, sees)) return found;
  }
  return nearest_.place(point, normal);
}

std::optional<MeshPlace> MeshLookup::place(const Vec3& point, const Vec3& normal) const {
  if (auto found = covering(point, normal)) return found;
  return nearest(point, normal);
}

/// Whether another triangle may have the light of the point.
bool MeshLookup::doubtful(const Search& search) const {
  return sight_ && search.best &&
         sight_->doubtful(static_cast<std::size_t>(search.best - grids_.facets().data()));
}

/// Grid by grid, so that all wait for memory together.
void MeshLookup::look_together(std::span<Search> searches) const {
  const VoxelTable& voxels = grids_.voxels();
  for (int grid = 0; grid < grids_.count(); ++grid) {
    const auto for_open = [&](const auto& act) {
      for (Search& search : searches) {
        if (search.open(grid)) act(search);
      }
    };
    for_open([&](Search& search) {
      search.key = grids_.voxel_of(search.from_middle, grid);
      voxels.prefetch(search.key);
    });
    for_open([&](Search& search) {
      search.listed = voxels.find(search.key);
      __builtin_prefetch(search.listed.data());
    });
    for_open([&](const Search& search) {
      for (const std::uint32_t index : search.listed) __builtin_prefetch(&grids_.facets()[index]);
    });
    for_open([&](Search& search) { look_among(search.listed, search); });
  }
}

void MeshLookup::look_among(std::span<const std::uint32_t> listed, Search& search) const {
  for (const std::uint32_t index : listed) {
    const Facet& facet = grids_.facets()[index];
    if (search.object != kAny && facet.object != search.object) continue;
    const std::optional<FacetOver> found = over(facet, index, search.p, search.n);
    // The nearest sheet; in it the triangle whose sides are kept best.
    if (!found || (search.best && found->score >= search.score)) continue;
    search.best = &facet;
    search.score = found->score;
    search.weights = found->weights;
    const float sure = search.object == kAny ? kSure : kOwnSure;
    search.sure = found->inside && found->score < sure * Facet::kHeight;
    if (search.sure) return;
  }
}

}  // namespace isolux
