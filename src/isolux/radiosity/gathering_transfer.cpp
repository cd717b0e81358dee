#include <algorithm>
#include <cmath>
#include <numeric>

#include "isolux/radiosity/gathering_procedure.h"
#include "isolux/radiosity/spatial_order.h"

namespace isolux {
namespace {

constexpr double kSamplingShare = 0.6;  // of the tolerance: σ of E_i
constexpr double kUnshotShare = 0.02;   // of the tolerance: light not yet passed on

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
  constexpr double kMostNoise = 3;
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
    trace_as_wanted(gatherers, HemisphereGather::kFinestGrid);
    gatherers.clear();
  }
  glimpse();
}

/// As wanted, but not coarser than they have.
void Gathering::trace_as_wanted(std::span<const VertexId> vertices, int finest) {
  const std::vector<int> wanted = wanted_grids();
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

/// E_i by links, under the light of the moment, with its σ.
Gathered Gathering::gather(std::span<const Landing> row) const {
  Gathered gathered = hemisphere_->gather_with_error(row, state_.sent);
  gathered.irradiance = gathered.irradiance * state_.balance;
  return gathered;
}

/// E_i of vertices with links, under the light of the moment, with its σ.
void Gathering::evaluate(std::span<const VertexId> vertices) {
  parallel_for(vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      VertexLight& light = state_.light[vertices[i]];
      if (!light.gathers) continue;
      const Gathered gathered = gather(light.row);
      light.indirect = gathered.irradiance;
      light.indirect_deviation = gathered.error;
    }
  });
  for (const VertexId v : vertices) sum_up(v);
}

/// Of a vertex without: from those that it lies among, whose chances are independent.
void Gathering::interpolate_indirect(VertexId v) {
  VertexLight& light = state_.light[v];
  light.indirect = {};
  light.indirect_deviation = light.escaped = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double w = light.among.weights[k];
    if (w == 0) continue;
    const VertexLight& parent = state_.light[light.among.vertices[k]];
    light.indirect += parent.indirect * w;
    light.indirect_deviation += square(w * parent.indirect_deviation);
    light.escaped += parent.escaped * w;
  }
  light.indirect_deviation = std::sqrt(light.indirect_deviation);
}

/// The vertices, each after those that it lies among.
const std::vector<VertexId>& Gathering::order() {
  if (order_.size() != state_.light.size()) {
    order_.resize(state_.light.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(), [&](VertexId v, VertexId w) {
      return state_.light[v].depth < state_.light[w].depth;
    });
  }
  return order_;
}

/// What interpolating E_i costs at the vertices from `first` on that do not gather: their own bend,
/// and what those that they lie among inherit.
void Gathering::foresee_bends(VertexId first) {
  parallel_for(state_.light.size() - first, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = first + begin; v < first + end; ++v) {
      VertexLight& light = state_.light[v];
      if (light.gathers) continue;
      light.own_bend = rule_bend(VertexId(v));
      if (light.row.empty()) continue;
      const Gathered rough = gather(light.row);
      light.glimpse = luminance(rough.irradiance);
      light.glimpse_deviation = rough.error;
      light.own_bend = std::max(light.own_bend, surprise(VertexId(v)));
    }
  });
  const auto inherit = [&](VertexId v) {
    VertexLight& light = state_.light[v];
    if (light.gathers) return;
    light.bend = light.own_bend;
    for (std::size_t k = 0; k < 3; ++k) {
      light.bend += light.among.weights[k] * state_.light[light.among.vertices[k]].bend;
    }
  };
  if (first == 0) {
    for (const VertexId v : order()) inherit(v);
  } else {
    for (VertexId v = first; v < state_.light.size(); ++v)
      inherit(v);  // those of a split come first
  }
}

/// By how much interpolation is too bright around each vertex.
void Gathering::find_excess() {
  const std::vector<Edge> edges = living_edges(mesh_);
  indirect_excess_ =
      around_vertices(edges, [&](const Edge& e) { return signed_error(state_.indirect_error, e); });
  const std::vector<double> direct_excess =
      around_vertices(edges, [&](const Edge& e) { return signed_error(state_.direct_error, e); });
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    state_.light[v].excess = direct_excess[v] + indirect_excess_[v];
    sum_up(v);
  }
}

/// Passes the light on along the links, sweep by sweep, until little is unshot.
void Gathering::transfer() {
  find_excess();
  constexpr int kMostSweeps = 10'000;
  const double enough = kUnshotShare * state_.level;
  std::vector<VertexId> gatherers;
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    if (state_.light[v].gathers) gatherers.push_back(v);
  }
  for (int sweep = 0; sweep < kMostSweeps && keep_going(); ++sweep) {
    const std::vector<Rgb> old = state_.sent;
    parallel_for(gatherers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        VertexLight& light = state_.light[gatherers[i]];
        light.indirect = hemisphere_->gather(light.row, state_.sent) * state_.balance;
      }
    });
    for (const VertexId v : order()) {
      if (!state_.light[v].gathers) interpolate_indirect(v);
    }
    balance_indirect();
    for (VertexId v = 0; v < state_.light.size(); ++v) sum_up(v);
    settle_energy(old);
    if (state_.statistics.unshot_flux <= enough * state_.statistics.emitted_flux) break;
    add_ambient(old);
  }
  parallel_for(gatherers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      VertexLight& light = state_.light[gatherers[i]];
      light.indirect_deviation = gather(light.row).error;
    }
  });
  for (const VertexId v : order()) {
    if (!state_.light[v].gathers) interpolate_indirect(v);
  }
  foresee_bends(0);
}

/// In a closed scene all that is sent arrives: where interpolation gives a little more or less,
/// E_i is put right as a whole.
void Gathering::balance_indirect() {
  constexpr double kClosed = 1e-3;  // of the light sent, lost at most
  Rgb sent, received;
  double lost = 0;
  for (const Triangle& triangle : mesh_.triangles()) {
    if (!triangle.alive) continue;
    const std::uint32_t object = mesh_.vertex(triangle.vertices[0]).surface.object;
    const Rgb emission = lights_.separate()[object] ? Rgb{} : triangle.emission;
    for (VertexId v : triangle.vertices) {
      const VertexLight& light = state_.light[v];
      const double part = triangle.area / 3;
      const Rgb radiosity = emission + mesh_.vertex(v).reflectance * state_.sent[v];
      const double l = luminance(light.indirect);
      sent += radiosity * part;
      lost += luminance(radiosity) * light.escaped * part;
      received += light.indirect * (l > 0 ? part * (1 - indirect_excess_[v] / l) : 0);
    }
  }
  if (!(lost <= kClosed * luminance(sent))) return;
  const auto factor = [](double a, double b) { return b > 0 ? std::clamp(a / b, 0.9, 1.1) : 1; };
  const Rgb more{factor(sent.r, received.r), factor(sent.g, received.g),
                 factor(sent.b, received.b)};
  state_.balance = state_.balance * more;
  for (VertexLight& light : state_.light) light.indirect = light.indirect * more;
}

/// The balance after a sweep that began with the irradiances `old`.
void Gathering::settle_energy(std::span<const Rgb> old) {
  double absorbed = 0, escaped = 0, unshot = 0, incident = 0, total = 0;
  for (const Triangle& triangle : mesh_.triangles()) {
    if (!triangle.alive) continue;
    total += triangle.area;
    for (VertexId v : triangle.vertices) {
      const Vertex& vertex = mesh_.vertex(v);
      const double part = triangle.area / 3;
      const Rgb& rho = vertex.reflectance;
      incident += luminance(state_.sent[v]) * part;
      absorbed += luminance((gray(1) - rho) * state_.sent[v]) * part;
      escaped +=
          luminance(rho * state_.sent[v] + triangle.emission) * state_.light[v].escaped * part;
      unshot += std::abs(luminance(rho * (state_.sent[v] - old[v]))) * part;
    }
  }
  state_.statistics.absorbed_flux = absorbed;
  state_.statistics.escaped_flux = escaped;
  state_.statistics.unshot_flux = unshot;
  state_.statistics.imbalance = state_.statistics.emitted_flux - absorbed - escaped - unshot;
  state_.statistics.mean_irradiance = total > 0 ? incident / total : 0;
  state_.statistics.mesh_area = total;
}

/// Cohen's (1988) ambient term, given to every vertex in advance: what a sweep has added goes on
/// to be reflected, on average over all surfaces. The next sweep puts right how it is spread.
void Gathering::add_ambient(std::span<const Rgb> old) {
  Rgb added, reflected;
  double total = 0;
  for (const Triangle& triangle : mesh_.triangles()) {
    if (!triangle.alive) continue;
    for (VertexId v : triangle.vertices) {
      const Vertex& vertex = mesh_.vertex(v);
      const Rgb sent = vertex.reflectance * (1 - state_.light[v].escaped) * (triangle.area / 3);
      added += sent * (state_.sent[v] - old[v]);
      reflected += sent;
      total += triangle.area / 3;
    }
  }
  const auto ambient = [&](double a, double r) { return a / total / (1 - r / total); };
  const Rgb more{ambient(added.r, reflected.r), ambient(added.g, reflected.g),
                 ambient(added.b, reflected.b)};
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    state_.light[v].indirect += more;
    sum_up(v);
  }
}

}  // namespace isolux
