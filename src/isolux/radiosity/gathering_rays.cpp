#include <algorithm>
#include <cmath>
#include <limits>

#include "isolux/radiosity/gathering_procedure.h"
#include "isolux/radiosity/spatial_order.h"

namespace isolux {
namespace {

constexpr double kSamplingShare = 0.7;  // of the tolerance: σ of E_i
constexpr double kRenewalShare = 0.1;   // of it: what a row of links may gain from finer triangles
// ∫ φ² / ∫ φ of the function φ, linear over triangles, that is 1 at a vertex and 0 at all others.
constexpr double kHat = 0.5;

// Stands for the number of a site that is not listed yet.
constexpr std::uint32_t kFresh = std::numeric_limits<std::uint32_t>::max();

constexpr double kFall = 1.5;  // σ² falls as the number of rays to the power of −kFall
// Of E_i², as doubts() has it: 2 % at 64 rays.
constexpr double kLeastDoubt = 0.02 * 0.02 * 512;

}  // namespace

/// σ² of E_i by a single ray at each vertex, lx²: n rays over a grid have some n^−3/2 of it. Few
/// rays may be alike by chance: what neighbours saw counts too.
std::vector<double> Gathering::doubts() {
  const auto own = [&](VertexId v, double sigma) {
    const VertexLight& light = state_.light[v];
    const std::size_t cells = light.gathers ? square_of(light.grid) : light.row.cells();
    return square(sigma) * std::pow(double(cells), kFall);
  };
  const auto for_vertices = [&](const auto& body) {
    parallel_for(state_.light.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) body(static_cast<VertexId>(v));
    });
  };
  std::vector<double> seen(state_.light.size()), doubts(state_.light.size());
  for_vertices([&](VertexId v) {
    const VertexLight& light = state_.light[v];
    if (light.gathers) seen[v] = own(v, light.indirect_deviation);
  });
  for (const VertexId v : order()) {
    const VertexLight& light = state_.light[v];
    if (light.gathers) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      if (light.among.weights[k] > 0) {
        seen[v] += light.among.weights[k] * seen[light.among.vertices[k]];
      }
    }
  }
  for_vertices([&](VertexId v) {
    double sum = 0;
    const auto& triangles = mesh_.vertex(v).triangles;
    for (const TriangleId t : triangles) {
      for (const VertexId w : mesh_.triangle(t).vertices) sum += seen[w];
    }
    const VertexLight& light = state_.light[v];
    doubts[v] = std::max({seen[v], sum / (3.0 * double(std::max<std::size_t>(triangles.size(), 1))),
                          light.gathers ? 0 : own(v, light.glimpse_deviation),
                          kLeastDoubt * square(luminance(light.indirect))});
  });
  return doubts;
}

/// By vertex, m²: a third of the triangles around it, whose area is given, and parts of the areas
/// of those that are interpolated from it.
std::vector<double> Gathering::areas_of_influence(std::vector<double> around) {
  std::vector<double> areas = std::move(around);
  for (double& area : areas) area /= 3;
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
/// 1934); but nowhere is σ more than so many tolerances of E, or of what counts as dim, times the
/// leniency there.
std::vector<int> Gathering::wanted_grids() {
  constexpr double kMostNoise = 2;
  constexpr double kDim = 0.25;  // of the mean irradiance
  std::vector<int> grids(state_.light.size(), coarsest_grid());
  if (!(mean_irradiance() > 0)) return grids;
  const std::vector<double> areas_at = areas_around();
  std::vector<double> weights = areas_at;
  for (VertexId v = 0; v < weights.size(); ++v) weights[v] *= importance(v);
  const std::vector<double> areas = areas_of_influence(std::move(weights)), doubt = doubts();
  const auto worth = [&](VertexId v) {
    return std::pow(areas[v] * doubt[v] / square(scale(v)), 1 / (1 + kFall));
  };
  double sum = 0;
  for (VertexId v = 0; v < areas.size(); ++v) {
    if (state_.light[v].gathers) sum += worth(v);
  }
  const double allowed = square(kSamplingShare * state_.level) * area() / kHat;
  const double fineness = std::pow(sum / allowed, 1 / kFall);
  parallel_for(grids.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (auto v = static_cast<VertexId>(begin); v < end; ++v) {
      const double e = std::max(luminance(irradiance(v)), kDim * usual_irradiance(v));
      const double most = square(kMostNoise * leniency(v, areas_at[v]) * state_.level * e);
      const double least = std::pow(doubt[v] / most, 1 / kFall);
      const double side = std::ceil(std::sqrt(std::max(fineness * worth(v), least)));
      grids[v] = static_cast<int>(
          std::clamp(side, double(coarsest_grid()), double(HemisphereGather::kFinestGrid)));
    }
  });
  return grids;
}

/// New links for the vertices that gather and are worth clearly more rays than they have, or whose
/// links are out of date; again where that shows σ to be larger than it seemed, once it is known
/// how much light there is. A few for those that have none.
void Gathering::gather_all(int finest) {
  constexpr int kMostPasses = 4;
  constexpr double kClearly = 1.3;
  if (stopped_ && hemisphere_) return;
  std::vector<VertexId> gatherers = outdated_vertices();
  look_up_anew();
  const int passes = mean_irradiance() > 0 ? kMostPasses : 1;
  for (int pass = 0; pass < passes && !stopped_; ++pass) {
    const std::vector<int> wanted = wanted_grids();
    for (VertexId v = 0; v < state_.light.size(); ++v) {
      const VertexLight& light = state_.light[v];
      if (!light.gathers && light.depth > 0) continue;
      const std::uint64_t has = light.gathers ? square_of(light.grid) : light.row.cells();
      if (double(square_of(std::min(wanted[v], finest))) > kClearly * double(has)) {
        gatherers.push_back(v);
      }
    }
    if (gatherers.empty()) break;
    std::sort(gatherers.begin(), gatherers.end());
    gatherers.erase(std::unique(gatherers.begin(), gatherers.end()), gatherers.end());
    trace_as_wanted(gatherers, wanted, finest);
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
    const int has = light.gathers ? light.grid : 0;
    grids.push_back(std::max(std::min(wanted[v], finest), has));
  }
  trace(vertices, grids);
  evaluate(vertices);
}

/// Gives the vertices links of their own, over grids of so many cells a side.
void Gathering::trace(std::span<const VertexId> vertices, std::span<const int> grids) {
  std::vector<Vec3> places;
  for (VertexId v : vertices) places.push_back(mesh_.vertex(v).position);
  const std::vector<std::uint32_t> order = z_order(places);
  std::vector<RowRequest> requests;
  for (const std::uint32_t i : order) {
    const Vertex& vertex = mesh_.vertex(vertices[i]);
    requests.push_back({{vertex.gather_point, vertex.normal}, grids[i], vertices[i]});
  }
  trace_rows(requests,
             [&](std::size_t i, TracedRow row) { give_links(vertices[order[i]], std::move(row)); });
}

/// Traces rows in parallel, and hands them out one after the other, until told to stop.
void Gathering::trace_rows(std::span<const RowRequest> requests,
                           const std::function<void(std::size_t, TracedRow)>& take) {
  // Few at a time, for the sake of memory, and not to look at the clock too seldom.
  constexpr std::size_t kRows = 512, kFew = 16;
  constexpr std::uint64_t kRays = std::uint64_t{1} << 20;
  std::vector<TracedRow> rows;
  for (std::size_t first = 0; first < requests.size() && keep_going(); first += rows.size()) {
    const auto rest = requests.subspan(first, std::min(kRows, requests.size() - first));
    std::uint64_t rays = 0;
    const auto enough = std::find_if(rest.begin(), rest.end(), [&](const RowRequest& request) {
      return (rays += square_of(request.grid)) > kRays;
    });
    rows.resize(std::max<std::size_t>(1, static_cast<std::size_t>(enough - rest.begin())));
    parallel_for(rows.size(), kFew, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) rows[i] = traced(rest[i]);
    });
    for (std::size_t i = 0; i < rows.size(); ++i) {
      list_fresh_sites(rows[i]);
      state_.statistics.refinement_rays += rows[i].rays;
      take(first + i, std::move(rows[i]));
    }
  }
}

/// A row whose sites are listed as far as they were before. Of many rays few are kept: what all
/// bring more than these hardly changes when, later, the light does.
Gathering::TracedRow Gathering::traced(const RowRequest& request) const {
  thread_local Row<Landing> landings;
  TracedRow row;
  const auto trace = [&](int grid, HemisphereGather::Rims rims) {
    hemisphere_->trace(request.receiver, grid, options_.seed, request.id, landings, rims);
    row.rays += landings.rays.size();
  };
  trace(request.grid, HemisphereGather::Rims::divided);
  row.grid = request.grid;
  row.escaped = mean_over(
      landings, [&](std::size_t i) { return double(hemisphere_->lost(landings.rays[i].site)); });
  if (request.grid > kWholeGrid) {
    row.beyond = hemisphere_->gather_with_error(landings, state_.sent);
    trace(kKeptGrid, HemisphereGather::Rims::as_they_are);
    row.beyond.irradiance -= hemisphere_->gather(landings, state_.sent);
  }
  row.links = {landings.grid, landings.divided, {}};
  row.links.rays.reserve(landings.rays.size());
  for (const Landing& landing : landings.rays) {
    const std::optional<std::uint32_t> site = state_.sites.find(landing.site);
    row.links.rays.push_back({site.value_or(kFresh), landing.weights});
    if (!site) row.fresh.push_back(landing.site);
  }
  return row;
}

void Gathering::list_fresh_sites(TracedRow& row) {
  auto site = row.fresh.begin();
  for (Link& link : row.links.rays) {
    if (link.site == kFresh) link.site = state_.sites.add(*site++);
  }
  row.fresh = {};
}

void Gathering::give_links(VertexId v, TracedRow row) {
  VertexLight& light = state_.light[v];
  light.escaped = row.escaped;
  light.bend = 0;
  light.gathers = true;
  light.grid = row.grid;
  light.rays = static_cast<std::uint32_t>(row.rays);
  light.beyond = row.beyond.irradiance;
  light.indirect_deviation = row.beyond.error;
  light.row = std::move(row.links);
}

/// The vertices whose rays landed on edges that are split since, where this matters: the mesh knows
/// the light there better now.
std::vector<VertexId> Gathering::outdated_vertices() const {
  if (state_.split_since.empty()) return {};
  const double matters = kRenewalShare * state_.level;
  std::vector<char> touched(state_.light.size());  // ends of such edges
  for (const auto& [edge, error] : state_.split_since)
    touched[edge >> 32] = touched[edge & 0xffffffff] = 1;
  const std::uint32_t outside = HemisphereGather::outside_of(rays_.scene());
  const auto gain_of = [&](const Site& site) {
    if (site.surface == outside) return 0.0;
    const auto& v = site.vertices;
    if (touched[v[0]] + touched[v[1]] + touched[v[2]] < 2) return 0.0;
    double most = 0;
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(v[k], v[(k + 1) % 3]);
      const auto split = state_.split_since.find(Edge{a, b}.key());
      if (split != state_.split_since.end()) most = std::max(most, double(split->second));
    }
    return most > 0 ? most * luminance(mesh_.vertex(v[0]).reflectance) / 2 : 0;
  };
  std::vector<double> gain;
  for (const Site& site : state_.sites.sites()) gain.push_back(gain_of(site));
  std::vector<char> renew(state_.light.size());
  parallel_for(renew.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Row<Link>& row = state_.light[v].row;
      renew[v] = state_.light[v].gathers && mean_over(row, [&](std::size_t i) {
                                              return gain[row.rays[i].site];
                                            }) > matters * scale(static_cast<VertexId>(v));
    }
  });
  std::vector<VertexId> vertices;
  for (VertexId v = 0; v < renew.size(); ++v) {
    if (renew[v]) vertices.push_back(v);
  }
  return vertices;
}

/// Landings from here on are looked up in the mesh as it is now.
void Gathering::look_up_anew() {
  drop_unused_sites();
  hemisphere_.emplace(rays_, mesh_, lights_.separate(), state_.sent);
  state_.split_since.clear();
}

/// Lists the sites anew that links lead to.
void Gathering::drop_unused_sites() {
  SiteTable kept;
  std::vector<std::uint32_t> renamed(state_.sites.sites().size(), kFresh);
  for (VertexLight& light : state_.light) {
    for (Link& link : light.row.rays) {
      std::uint32_t& site = renamed[link.site];
      if (site == kFresh) site = kept.add(state_.sites.sites()[link.site]);
      link.site = site;
    }
  }
  state_.sites = std::move(kept);
}

/// What all sites send under the light of the moment.
void Gathering::light_sites() {
  const std::span<const Site> sites = state_.sites.sites();
  site_light_.resize(sites.size());
  parallel_for(sites.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      site_light_[i] = hemisphere_->light_of(sites[i], state_.sent);
    }
  });
}

/// Gives a few links to the vertices that have none, for a rough look at E_i.
void Gathering::glimpse() {
  constexpr int kFewRays = 4;  // cells a side
  std::vector<VertexId> blind;
  std::vector<RowRequest> requests;
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    if (mesh_.vertex(v).hidden || !state_.light[v].row.empty()) continue;
    const Vertex& vertex = mesh_.vertex(v);
    blind.push_back(v);
    requests.push_back({{vertex.gather_point, vertex.normal}, kFewRays, v});
  }
  trace_rows(requests, [&](std::size_t i, TracedRow row) {
    state_.light[blind[i]].row = std::move(row.links);
  });
}

}  // namespace isolux
