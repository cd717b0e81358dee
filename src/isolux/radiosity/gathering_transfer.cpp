#include <algorithm>
#include <cmath>
#include <numeric>

#include "isolux/radiosity/gathering_procedure.h"

namespace isolux {
namespace {

// Of the tolerance: light not yet passed on, while it is found out who gathers, and then.
constexpr double kRoughUnshotShare = 0.1;
constexpr double kUnshotShare = 0.02;

/// What few rays bring, and all brought more under other light, may add up to less than nothing.
Rgb positive(const Rgb& c) { return {std::max(c.r, 0.0), std::max(c.g, 0.0), std::max(c.b, 0.0)}; }

}  // namespace

/// E_i by links, under the light as of light_sites(), with its σ.
Gathered Gathering::gather(const Row<Link>& row) const {
  Gathered gathered = gather_with_error(row, site_light_);
  gathered.irradiance = gathered.irradiance * state_.balance;
  return gathered;
}

/// The same by a row of which some rays are kept.
Gathered Gathering::gather(const TracedRow& row) const {
  if (row.grid == row.links.grid) return gather(row.links);
  const Rgb irradiance = isolux::gather(row.links, site_light_) + row.beyond.irradiance;
  return {positive(irradiance) * state_.balance, row.beyond.error};
}

/// E_i of a vertex that gathers, under the light as of light_sites().
Rgb Gathering::gathered_by(const VertexLight& light) const {
  return positive(isolux::gather(light.row, site_light_) + light.beyond) * state_.balance;
}

/// E_i of vertices with links, under the light of the moment, with its σ.
void Gathering::evaluate(std::span<const VertexId> vertices) {
  light_sites();
  parallel_for(vertices.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      VertexLight& light = state_.light[vertices[i]];
      if (!light.gathers) continue;
      light.indirect = gathered_by(light);
      if (light.grid == light.row.grid) light.indirect_deviation = gather(light.row).error;
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
      if (light.gathers || mesh_.vertex(VertexId(v)).hidden) continue;
      light.own_bend = std::max(rule_bend(VertexId(v)), bend_beside(VertexId(v)));
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
      around_vertices(edges, [&](const Edge& e) { return likely_indirect_error(e); });
  const std::vector<double> direct_excess =
      around_vertices(edges, [&](const Edge& e) { return direct_error(e); });
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    state_.light[v].excess = direct_excess[v] + indirect_excess_[v];
    sum_up(v);
  }
}

/// Passes the light on along the links, sweep by sweep, until little is unshot.
void Gathering::transfer(bool rough) {
  find_excess();
  share_out();
  constexpr int kMostSweeps = 10'000;
  const double enough = (rough ? kRoughUnshotShare : kUnshotShare) * state_.level;
  std::vector<VertexId> gatherers;
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    if (state_.light[v].gathers) gatherers.push_back(v);
  }
  for (int sweep = 0; sweep < kMostSweeps && keep_going(); ++sweep) {
    const std::vector<Rgb> old = state_.sent;
    light_sites();
    parallel_for(gatherers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        VertexLight& light = state_.light[gatherers[i]];
        light.indirect = gathered_by(light);
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
  light_sites();
  parallel_for(gatherers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      VertexLight& light = state_.light[gatherers[i]];
      if (light.grid == light.row.grid) light.indirect_deviation = gather(light.row).error;
    }
  });
  for (const VertexId v : order()) {
    if (!state_.light[v].gathers) interpolate_indirect(v);
  }
  foresee_bends(0);
}

/// What of the mesh counts by each vertex.
void Gathering::share_out() {
  constexpr double kSeen = 0.5;  // of triangles that reach out from under a sheet
  shares_.assign(state_.light.size(), {});
  for (const Triangle& triangle : mesh_.triangles()) {
    if (!triangle.alive) continue;
    const std::uint32_t object = mesh_.vertex(triangle.vertices[0]).surface.object;
    const double part = triangle.area / 3;
    const Rgb emitted = triangle.emission * part;
    for (const VertexId v : triangle.vertices) {
      shares_[v].area += part;
      const double seen = mesh_.vertex(v).hidden ? kSeen : 1;
      shares_[v].seen += seen * part;
      shares_[v].emitted += emitted;
      if (!lights_.separate()[object]) shares_[v].emitted_to_rays += emitted * seen;
    }
  }
}

/// In a closed scene all that is sent arrives: where interpolation gives a little more or less,
/// E_i is put right as a whole, by no more than some per cent.
void Gathering::balance_indirect() {
  constexpr double kClosed = 1e-3;  // of the light sent, lost at most
  constexpr double kMost = 1.1;
  Rgb sent, received;
  double lost = 0;
  for (VertexId v = 0; v < shares_.size(); ++v) {
    const VertexLight& light = state_.light[v];
    const Share& share = shares_[v];
    const Rgb flux =
        share.emitted_to_rays + mesh_.vertex(v).reflectance * state_.sent[v] * share.seen;
    const double l = luminance(light.indirect);
    sent += flux;
    lost += luminance(flux) * light.escaped;
    received += light.indirect * (l > 0 ? share.seen * (1 - indirect_excess_[v] / l) : 0);
  }
  const Rgb before = state_.balance;
  closed_ = !rays_.scene().sky && lost <= kClosed * luminance(sent);
  const auto balanced = [&](double now, double out, double in) {
    return closed_ && in > 0 ? std::clamp(now * out / in, 1 / kMost, kMost) : 1;
  };
  state_.balance = {balanced(before.r, sent.r, received.r), balanced(before.g, sent.g, received.g),
                    balanced(before.b, sent.b, received.b)};
  const Rgb more{state_.balance.r / before.r, state_.balance.g / before.g,
                 state_.balance.b / before.b};
  for (VertexLight& light : state_.light) light.indirect = light.indirect * more;
}

/// The balance after a sweep that began with the irradiances `old`.
void Gathering::settle_energy(std::span<const Rgb> old) {
  double absorbed = 0, escaped = 0, unshot = 0, incident = 0, total = 0;
  for (VertexId v = 0; v < shares_.size(); ++v) {
    const Share& share = shares_[v];
    const Rgb& rho = mesh_.vertex(v).reflectance;
    const Rgb received = state_.sent[v] * share.seen;
    total += share.area;
    incident += luminance(received);
    absorbed += luminance((gray(1) - rho) * received);
    escaped += luminance(rho * received + share.emitted) * state_.light[v].escaped;
    unshot += std::abs(luminance(rho * (state_.sent[v] - old[v]))) * share.seen;
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
  for (VertexId v = 0; v < shares_.size(); ++v) {
    const Rgb& rho = mesh_.vertex(v).reflectance;
    const Rgb sent = rho * (1 - state_.light[v].escaped) * shares_[v].area;
    added += sent * (state_.sent[v] - old[v]);
    reflected += sent;
    total += shares_[v].area;
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
