#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "isolux/discretization/split_points.h"
#include "isolux/radiosity/gathering_procedure.h"
#include "isolux/radiosity/spatial_order.h"

namespace isolux {
namespace {

// The part of the tolerance that interpolation of E_d may cost.
constexpr double kDirectShare = 0.55;

// Edges are not split to less than this part of the tolerance times the size of the room.
constexpr double kHairline = 0.1;

// A round of splits takes on the worst edges, which make up this part of the estimated error
// squared: the bulk criterion of Dörfler (1996).
constexpr double kBulk = 0.7;

// Edges of the smallest area, all together this part of the mesh's, are looked at one in so many,
// as long as those that are not make up no more than this part of the error squared.
constexpr double kLittle = 0.02;
constexpr std::size_t kEvery = 8;
constexpr double kUnseen = 0.05;

// σ where nobody looked.
constexpr float kUnknown = std::numeric_limits<float>::infinity();

/// How many of the edges, from the first, have no more than this area together.
std::size_t edges_within(std::span<const Edge> edges, double area) {
  double sum = 0;
  std::size_t n = 0;
  while (n < edges.size() && (sum += edges[n].area) <= area) ++n;
  return n;
}

}  // namespace

/// E_d of vertices, as closely as the level asks for.
void Gathering::light_directly(std::span<const VertexId> vertices) {
  std::vector<Receiver> receivers;
  for (const VertexId v : vertices) {
    const Vertex& vertex = mesh_.vertex(v);
    receivers.push_back({vertex.gather_point, vertex.normal});
  }
  std::vector<Rgb> irradiance(receivers.size());
  std::vector<double> deviation(receivers.size());
  lights_.irradiance(receivers, irradiance, deviation, state_.level);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    state_.light[vertices[i]].direct = irradiance[i];
    state_.light[vertices[i]].direct_deviation = deviation[i];
    sum_up(vertices[i]);
  }
}

/// E_d of the vertices that have none yet.
void Gathering::light_newborn() {
  std::vector<VertexId> newborn(mesh_.vertices().size() - state_.light.size());
  std::iota(newborn.begin(), newborn.end(), static_cast<VertexId>(state_.light.size()));
  state_.light.resize(mesh_.vertices().size());
  state_.sent.resize(mesh_.vertices().size());
  light_directly(newborn);
}

/// Whether σ of E_d is too much for the level, where errors are held against `scale`, lx.
bool Gathering::too_open(double deviation, double scale) const {
  constexpr double kTooOpen = 0.3;  // of the tolerance
  return deviation > kTooOpen * state_.level * scale;
}

/// Looks closer at E_d of vertices where a shadow's edge on a light was left too open for a
/// stricter level; lets all edges be looked at again that were not.
void Gathering::look_closer() {
  std::erase_if(state_.middles, [](const auto& m) { return m.second.deviation == kUnknown; });
  std::vector<VertexId> open;
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    const VertexLight& light = state_.light[v];
    if (!mesh_.vertex(v).hidden && too_open(light.direct_deviation, scale(v))) open.push_back(v);
  }
  light_directly(open);
  light_hidden();
}

/// The surface over the middles of `chosen` edges, and E_d there, if it is not known well enough,
/// until told to stop.
void Gathering::light_middles(std::span<const Edge> edges, std::span<const std::uint32_t> chosen,
                              std::span<Middle> middles) {
  parallel_for(chosen.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Edge& edge = edges[chosen[i]];
      auto& point = middles[chosen[i]].point;
      point = point_over_edge(mesh_, rays_, edge.a, edge.b);
      if (point && hidden(*point, edge)) point.reset();
    }
  });
  std::vector<Receiver> receivers;
  std::vector<std::uint32_t> of;
  for (std::uint32_t i : chosen) {
    if (!middles[i].point) continue;
    const auto known = state_.middles.find(edges[i].key());
    if (known != state_.middles.end() && !too_open(known->second.deviation, scale(edges[i]))) {
      const auto& [direct, deviation, error] = known->second;
      middles[i].direct = {direct[0], direct[1], direct[2]};
      middles[i].deviation = deviation;
      continue;
    }
    receivers.push_back({middles[i].point->position, middles[i].point->normal});
    of.push_back(i);
  }
  std::vector<Rgb> irradiance(of.size());
  std::vector<double> deviation(of.size());
  lights_.irradiance(receivers, irradiance, deviation, state_.level,
                     [this] { return keep_going(); });
  for (std::size_t i = 0; i < of.size(); ++i) {
    middles[of[i]].direct = irradiance[i];
    middles[of[i]].deviation = deviation[i];
  }
}

/// The surface over the middles of edges, and E_d there, until told to stop.
std::vector<Gathering::Middle> Gathering::middles_of(std::span<const Edge> edges) {
  std::vector<Middle> middles(edges.size());
  std::vector<Vec3> places;
  for (const Edge& e : edges) {
    places.push_back((mesh_.vertex(e.a).position + mesh_.vertex(e.b).position) / 2);
  }
  const std::vector<std::uint32_t> order = z_order(places);
  for (std::size_t first = 0; first < edges.size() && keep_going(); first += kChunk) {
    light_middles(edges, std::span(order).subspan(first, std::min(kChunk, edges.size() - first)),
                  middles);
  }
  return middles;
}

/// e of E_d at the middle of an edge, signed; what chance adds to it left out.
double Gathering::error_at(const Edge& edge, const Middle& middle) const {
  if (!middle.point) return 0;
  const VertexLight &a = state_.light[edge.a], &b = state_.light[edge.b];
  const double e = luminance((a.direct + b.direct) / 2 - middle.direct);
  const double noise =
      middle.deviation * middle.deviation +
      (a.direct_deviation * a.direct_deviation + b.direct_deviation * b.direct_deviation) / 4;
  return std::copysign(std::sqrt(std::max(0.0, e * e - noise)), e);
}

MiddleLight Gathering::packed(const Middle& middle, double error) {
  const Rgb& e = middle.direct;
  return {{static_cast<float>(e.r), static_cast<float>(e.g), static_cast<float>(e.b)},
          static_cast<float>(middle.deviation),
          static_cast<float>(error)};
}

/// Splits edges until interpolation of E_d costs no more than its share.
void Gathering::refine_direct() {
  while (!stopped_) {
    mesh_.compact();
    if (callbacks_.checkpoint) callbacks_.checkpoint(state_);
    const std::vector<Edge> edges = living_edges(mesh_);
    sample(edges);
    const double target = square(kDirectShare * state_.level);
    const std::vector<double> errors =
        of_edges(edges, [&](const Edge& e) { return direct_error(e); });
    const double total = direct_mean_square(edges, errors);
    state_.direct_mean_square = total;
    if (stopped_ || total <= target || full()) return;
    const std::size_t before = mesh_.vertices().size();
    split_worst(edges, errors, total, target);
    if (mesh_.vertices().size() == before) return;
  }
}

/// E_d in the middles of edges that were not looked at yet; of the smallest, as many as it takes to
/// know that the others do not matter.
void Gathering::sample(std::span<const Edge> edges) {
  if (state_.middles.size() > 3 * edges.size()) {
    std::unordered_map<std::uint64_t, MiddleLight> living;
    for (const Edge& e : edges) {
      if (const auto at = state_.middles.find(e.key()); at != state_.middles.end())
        living.insert(*at);
    }
    state_.middles.swap(living);
  }
  std::vector<Edge> fresh;
  for (const Edge& e : edges) {
    if (!state_.middles.contains(e.key())) fresh.push_back(e);
  }
  std::sort(fresh.begin(), fresh.end(), [](const Edge& e, const Edge& f) {
    return std::pair(e.area, e.key()) < std::pair(f.area, f.key());
  });
  // Of the smallest, every so many first: they tell how many need no look.
  const bool many = fresh.size() > edges.size() / kEvery;
  const std::size_t little = many ? edges_within(fresh, kLittle * 3 * area()) : 0;
  std::vector<Edge> first, rest;
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    if (i >= little || i % kEvery == 0) first.push_back(fresh[i]);
  }
  look_at(first);
  const double bearable = kUnseen * square(kDirectShare * state_.level) * area();
  double unseen = 0;
  for (std::size_t i = 0; i < little && !stopped_; ++i) {
    if (i % kEvery == 0) {
      unseen += double(kEvery) * cost(fresh[i], direct_error(fresh[i]));
    } else if (unseen > bearable) {
      rest.push_back(fresh[i]);
    } else {
      state_.middles[fresh[i].key()] = MiddleLight{{}, kUnknown, 0};
    }
  }
  look_at(rest);
}

void Gathering::look_at(std::span<const Edge> edges) {
  const std::vector<Middle> middles = middles_of(edges);
  for (std::size_t i = 0; i < edges.size() && !stopped_; ++i) {
    state_.middles[edges[i].key()] = packed(middles[i], error_at(edges[i], middles[i]));
  }
}

/// How far interpolation of E_d is off in the middle of an edge, lx; as a rule, if nobody looked.
double Gathering::direct_bend(const Edge& edge) const {
  constexpr double kUsual = 0.25;  // of the difference between the ends
  const auto known = state_.middles.find(edge.key());
  if (known != state_.middles.end() && known->second.deviation < kUnknown) {
    return std::abs(known->second.error);
  }
  return kUsual * std::abs(luminance(state_.light[edge.a].direct - state_.light[edge.b].direct));
}

/// Whether an edge is too short to be split. Along steps of light so narrow, halving the error
/// takes four times the edges, and where shadows are hard there is no end to it: what such edges
/// are off is in the errors of their vertices and told by itself, but left out of the whole.
bool Gathering::hairline(const Edge& edge) const {
  const double shortest = kHairline * state_.level * std::min(extent(edge.a), extent(edge.b));
  return distance(mesh_.vertex(edge.a).position, mesh_.vertex(edge.b).position) < shortest;
}

double Gathering::direct_mean_square(std::span<const Edge> edges, std::span<const double> errors) {
  double narrow = 0, bias = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Edge& e = edges[i];
    if (errors[i] == 0) continue;
    if (hairline(e)) narrow += cost(e, errors[i]);
    bias += errors[i] * e.area / 3;
  }
  state_.bias = bias / area();
  state_.narrow_mean_square = narrow / area();
  return mean_square([&](const Edge& e) {
    const double error = direct_error(e);
    return EdgeError{error == 0 || hairline(e) ? 0 : error / scale(e)};
  });
}

/// Splits the edges that the bulk criterion names.
void Gathering::split_worst(std::span<const Edge> edges, std::span<const double> errors,
                            double total, double target) {
  std::vector<std::pair<double, std::uint32_t>> ranked;
  double whole = 0;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    if (errors[i] == 0 || hairline(edges[i])) continue;
    const double share = cost(edges[i], errors[i]);
    ranked.emplace_back(-share, i);
    whole += share;
  }
  std::sort(ranked.begin(), ranked.end());
  // Splits leave about a tenth of an edge's cost behind; there is no need to go below the target.
  const double enough = std::min(kBulk, 1.1 * (1 - target / total)) * whole;
  double taken = 0;
  std::vector<Edge> worst;
  for (const auto& [minus_share, i] : ranked) {
    if (taken >= enough) break;
    taken -= minus_share;
    worst.push_back(edges[i]);
  }
  split_all(worst);
}

/// Splits these edges, and before them sides that are much longer than they are, of which they
/// would leave slivers (the longest first: Rivara 1984).
void Gathering::split_all(std::span<const Edge> edges) {
  const std::vector<Edge> longer = longer_sides(edges);
  const std::vector<Middle> middles = middles_of(edges);
  split(longer, middles_of(longer));
  split(edges, middles);
}

/// The longest sides of the triangles at these edges, where they are much longer.
std::vector<Edge> Gathering::longer_sides(std::span<const Edge> edges) const {
  constexpr double kMuchLonger = 1.8;
  const auto length_of = [&](VertexId a, VertexId b) {
    return distance(mesh_.vertex(a).position, mesh_.vertex(b).position);
  };
  std::vector<Edge> longer;
  for (const Edge& e : edges) {
    const double own = length_of(e.a, e.b);
    for (const auto& id : {mesh_.triangle_at(e.a, e.b), mesh_.triangle_at(e.b, e.a)}) {
      if (!id) continue;
      const auto& v = mesh_.triangle(*id).vertices;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(v[k], v[(k + 1) % 3]);
        if (length_of(a, b) > kMuchLonger * own) longer.push_back({a, b, 0});
      }
    }
  }
  const auto by_ends = [](const Edge& e, const Edge& f) { return e.key() < f.key(); };
  std::sort(longer.begin(), longer.end(), by_ends);
  longer.erase(std::unique(longer.begin(), longer.end(),
                           [](const Edge& e, const Edge& f) { return e.key() == f.key(); }),
               longer.end());
  return longer;
}

/// Makes the middles vertices; E_i is interpolated.
void Gathering::split(std::span<const Edge> edges, std::span<const Middle> middles) {
  const auto first = static_cast<VertexId>(state_.light.size());
  for (std::size_t i = 0; i < edges.size() && !full() && !stopped_; ++i) {
    const auto& [a, b, area] = edges[i];
    if (!middles[i].point) continue;
    const std::optional<VertexId> v = mesh_.split_edge(a, b, *middles[i].point);
    if (!v) {
      state_.middles[edges[i].key()] = packed(middles[i], 0);  // stays: nothing to gain here
      continue;
    }
    ++state_.statistics.split;
    state_.split_since[edges[i].key()] =
        static_cast<float>(std::abs(direct_error(edges[i]) + likely_indirect_error(edges[i])));
    state_.light.resize(mesh_.vertices().size());
    state_.sent.resize(mesh_.vertices().size());
    VertexLight& light = state_.light[*v];
    light.direct = middles[i].direct;
    light.direct_deviation = middles[i].deviation;
    state_.give_parents(*v, {{a, b, a}, {0.5, 0.5, 0}});
  }
  for (VertexId v = first; v < state_.light.size(); ++v) {
    interpolate_indirect(v);
    sum_up(v);
  }
  foresee_bends(first);
}

}  // namespace isolux
