#include <algorithm>
#include <cmath>

#include "isolux/radiosity/gathering_procedure.h"
#include "isolux/radiosity/spatial_order.h"

namespace isolux {
namespace {

constexpr double kSamplingShare = 0.6;  // of the tolerance: σ of E_i

constexpr int kCoarsestGrid = 8;  // rays over a hemisphere: cells a side
constexpr double kFall = 1.5;     // σ² falls as the number of rays to the power of −kFall
// Of E_i², as doubts() has it: 2 % at 64 rays.
constexpr double kLeastDoubt = 0.02 * 0.02 * 512;

}  // namespace

/// σ² of E_i by a single ray at each vertex, lx²: n rays over a grid have some n^−3/2 of it. Few
/// rays may be alike by chance: what neighbours saw counts too.
std::vector<double> Gathering::doubts() {
  const auto own = [&](VertexId v, double sigma) {
    return square(sigma) * std::pow(double(state_.light[v].row.size()), kFall);
  };
  std::vector<double> seen(state_.light.size());
  for (const VertexId v : order()) {
    const VertexLight& light = state_.light[v];
    if (light.gathers) {
      seen[v] = own(v, light.indirect_deviation);
    } else {
      for (std::size_t k = 0; k < 3; ++k) {
        if (light.among.weights[k] > 0) {
          seen[v] += light.among.weights[k] * seen[light.among.vertices[k]];
        }
      }
    }
  }
  std::vector<double> doubts(seen.size());
  for (VertexId v = 0; v < doubts.size(); ++v) {
    double sum = 0;
    const auto& triangles = mesh_.vertex(v).triangles;
    for (const TriangleId t : triangles) {
      for (const VertexId w : mesh_.triangle(t).vertices) sum += seen[w];
    }
    const VertexLight& light = state_.light[v];
    doubts[v] = std::max({seen[v], sum / (3.0 * double(std::max<std::size_t>(triangles.size(), 1))),
                          light.gathers ? 0 : own(v, light.glimpse_deviation),
                          kLeastDoubt * square(luminance(light.indirect))});
  }
  return doubts;
}

/// By vertex, m²: a third of the triangles around it, and parts of the areas of those that are
/// interpolated from it.
std::vector<double> Gathering::areas_of_influence() {
  std::vector<double> areas(state_.light.size());
  for (VertexId v = 0; v < areas.size(); ++v) areas[v] = area_around(v) / 3;
  const std::vector<VertexId>& forth = order();
  for (auto v = forth.rbegin(); v != forth.rend(); ++v) {
    const VertexLight& light = state_.light[*v];
    if (light.gathers) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      areas[light.among.vertices[k]] += light.among.weights[k] * areas[*v];
    }
  }
  return areas;
}

/// The grids of rays, in cells a side, that keep σ within its share of the tolerance over all
/// surfaces. For so many rays as it takes, one more anywhere takes as much off Σ A σ² (Neyman
/// 1934); but nowhere is σ more than so many tolerances of E.
std::vector<int> Gathering::wanted_grids() {
  constexpr double kMostNoise = 2;
  const std::vector<double> areas = areas_of_influence(), doubt = doubts();
  const auto worth = [&](VertexId v) { return std::pow(areas[v] * doubt[v], 1 / (1 + kFall)); };
  double sum = 0;
  for (VertexId v = 0; v < areas.size(); ++v) {
    if (state_.light[v].gathers) sum += worth(v);
  }
  const double allowed = square(kSamplingShare * state_.level * mean_irradiance()) * area();
  const double fineness = allowed > 0 ? std::pow(sum / allowed, 1 / kFall) : 0;
  std::vector<int> grids(areas.size());
  parallel_for(grids.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<VertexId>(begin); v < end; ++v) {
      const double most = square(kMostNoise * state_.level * luminance(irradiance(v)));
      const double least = most > 0 ? std::pow(doubt[v] / most, 1 / kFall) : 0;
      const double side = std::ceil(std::sqrt(std::max(fineness * worth(v), least)));
      grids[v] = static_cast<int>(
          std::clamp(side, double(kCoarsestGrid), double(HemisphereGather::kFinestGrid)));
    }
  });
  return grids;
}

/// New links for the vertices that gather and are worth clearly more rays than they have, or whose
/// links are out of date; again where that shows σ to be larger than it seemed. A few for those
/// that have none.
void Gathering::gather_all() {
  constexpr int kMostPasses = 4;
  constexpr double kClearly = 1.3;
  std::vector<VertexId> gatherers = outdated_vertices();
  look_up_anew();
  for (int pass = 0; pass < kMostPasses && !stopped_; ++pass) {
    const std::vector<int> wanted = wanted_grids();
    for (VertexId v = 0; v < state_.light.size(); ++v) {
      const VertexLight& light = state_.light[v];
      if (!light.gathers && light.depth > 0) continue;
      if (double(square_of(wanted[v])) > kClearly * double(light.row.size())) {
        gatherers.push_back(v);
      }
    }
    if (gatherers.empty()) break;
    std::sort(gatherers.begin(), gatherers.end());
    gatherers.erase(std::unique(gatherers.begin(), gatherers.end()), gatherers.end());
    trace_as_wanted(gatherers, wanted, HemisphereGather::kFinestGrid);
    gatherers.clear();
  }
  glimpse();
}

/// Rays as `wanted`, by vertex, in cells a side; not fewer than they have.
void Gathering::trace_as_wanted(std::span<const VertexId> vertices, std::span<const int> wanted,
                                int finest) {
  std::vector<int> grids;
  for (const VertexId v : vertices) {
    const VertexLight& light = state_.light[v];
    const double has = light.gathers ? std::sqrt(double(light.row.size())) : 0;
    grids.push_back(std::max(std::min(wanted[v], finest), static_cast<int>(std::lround(has))));
  }
  trace(vertices, grids);
  evaluate(vertices);
}

std::vector<Landing> Gathering::links(const Receiver& receiver, int grid, std::uint64_t id) const {
  std::vector<Landing> row(square_of(grid));
  hemisphere_->trace(receiver, grid, options_.seed, id, row);
  return row;
}

/// Gives the vertices links of their own, over grids of so many cells a side.
void Gathering::trace(std::span<const VertexId> vertices, std::span<const int> grids) {
  std::vector<Vec3> places;
  for (VertexId v : vertices) places.push_back(mesh_.vertex(v).position);
  const std::vector<std::uint32_t> order = z_order(places);
  for_pieces(vertices.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const VertexId v = vertices[order[i]];
      const Vertex& vertex = mesh_.vertex(v);
      give_links(v, links({vertex.gather_point, vertex.normal}, grids[order[i]], v));
    }
  });
  for (const int grid : grids) state_.statistics.refinement_rays += square_of(grid);
}

void Gathering::give_links(VertexId v, std::vector<Landing> row) {
  VertexLight& light = state_.light[v];
  light.escaped = hemisphere_->escaped(row);
  light.bend = 0;
  light.gathers = true;
  light.row = std::move(row);
}

/// Landings from here on are looked up in the mesh as it is now.
void Gathering::look_up_anew() {
  hemisphere_.emplace(rays_, mesh_, lights_.separate());
  state_.split_since.clear();
}

/// Gives a few links to the vertices that have none, for a rough look at E_i.
void Gathering::glimpse() {
  constexpr int kFewRays = 4;  // cells a side
  std::vector<VertexId> blind;
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    if (state_.light[v].row.empty()) blind.push_back(v);
  }
  const std::size_t done = for_pieces(blind.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vertex& vertex = mesh_.vertex(blind[i]);
      state_.light[blind[i]].row = links({vertex.gather_point, vertex.normal}, kFewRays, blind[i]);
    }
  });
  state_.statistics.refinement_rays += done * square_of(kFewRays);
}

}  // namespace isolux
