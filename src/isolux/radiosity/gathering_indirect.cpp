#include <algorithm>
#include <cmath>

#include "isolux/radiosity/gathering_procedure.h"

namespace isolux {
namespace {

constexpr double kIndirectShare = 0.65;  // of the tolerance: interpolation of E_i

// Of the error squared that is allowed, what vertices between gathering ones may make up, and what
// edges may.
constexpr double kVerticesPart = 0.5;
constexpr double kEdgesPart = 0.7;

// However small the area is where interpolation is off by more than this many tolerances of what it
// is held against (small triangles: up to thrice as many), vertices gather there, and edges are
// split as long as they are longer than this part of the longest.
constexpr double kMostBend = 1.5;
constexpr double kFinest = 1.0 / 64;

// E_i in the middle between two vertices is off their mean, as a rule, by this part of their
// difference;
constexpr double kUsualBend = 0.2;
// or by this part of E_i where they stand at right angles.
constexpr double kUsualTurn = 0.15;

/// Of `ranked` (the largest cost first), how many to take for the others to cost no more than
/// `budget`.
template <typename T>
std::size_t worth_taking(std::span<const std::pair<double, T>> ranked, double budget) {
  double rest = 0;
  std::size_t n = ranked.size();
  while (n > 0 && rest + ranked[n - 1].first <= budget) rest += ranked[--n].first;
  return n;
}

}  // namespace

/// How far apart E_i of two vertices is, what chance adds left out.
double Gathering::difference(VertexId v, VertexId w) const {
  const VertexLight &a = state_.light[v], &b = state_.light[w];
  const double noise = square(a.indirect_deviation) + square(b.indirect_deviation);
  return std::sqrt(std::max(0.0, square(luminance(a.indirect - b.indirect)) - noise));
}

/// How far E_i in the middle between two vertices is off their mean, as a rule: a part of their
/// difference, or of E_i where they are turned from each other.
double Gathering::usual_bend(VertexId v, VertexId w) const {
  const double mean = luminance(state_.light[v].indirect + state_.light[w].indirect) / 2;
  const double turn = 1 - dot(mesh_.vertex(v).normal, mesh_.vertex(w).normal);
  return std::max(kUsualBend * difference(v, w), kUsualTurn * mean * turn);
}

/// What interpolating E_i at a vertex among others costs, as a rule: as much more than in the
/// middle of two as Σ weight · distance² says.
double Gathering::rule_bend(VertexId v) const {
  constexpr double kMost = 1.5;
  const auto& [parents, weights] = state_.light[v].among;
  double bend = 0, spread = 0, longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[k] == 0) continue;
    const Vec3& at = mesh_.vertex(parents[k]).position;
    spread += weights[k] * length_squared(at - mesh_.vertex(v).position);
    for (std::size_t l = k + 1; l < 3; ++l) {
      if (weights[l] == 0) continue;
      longest = std::max(longest, length_squared(at - mesh_.vertex(parents[l]).position));
      bend = std::max(bend, usual_bend(parents[k], parents[l]));
    }
  }
  return longest > 0 ? state_.bend_scale * bend * std::min(kMost, 4 * spread / longest) : 0;
}

/// What interpolating E_i at a vertex may cost by what its neighbours in the mesh gathered, who may
/// stand nearer than those that it lies among.
double Gathering::bend_beside(VertexId v) const {
  double most = 0;
  for (const TriangleId t : mesh_.vertex(v).triangles) {
    for (const VertexId w : mesh_.triangle(t).vertices) {
      if (state_.light[w].gathers) most = std::max(most, difference(v, w));
    }
  }
  return state_.bend_scale * kUsualBend * most;
}

/// By how much interpolating E_i at a vertex among others goes against a glimpse of it.
double Gathering::surprise(VertexId v) const {
  constexpr double kSure = 2;           // σ of a glimpse
  constexpr double kLeastSigma = 0.04;  // of what is seen: few rays may be alike by chance
  const VertexLight& light = state_.light[v];
  double interpolated = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    interpolated +=
        light.among.weights[k] * luminance(state_.light[light.among.vertices[k]].indirect);
  }
  const double sigma = std::max(light.glimpse_deviation, kLeastSigma * interpolated);
  return std::max(0.0, std::abs(interpolated - light.glimpse) - kSure * sigma);
}

/// Lets vertices gather, and splits edges, where interpolation of E_i costs too much.
void Gathering::refine_indirect() {
  constexpr int kMostRounds = 24;
  constexpr std::size_t kFew = 500;  // edges for each place that is not worth another round
  const double target = square(kIndirectShare * state_.level) * area();
  state_.indirect_findings.clear();
  for (int round = 0; round < kMostRounds && !stopped_; ++round) {
    const std::vector<Edge> edges = living_edges(mesh_);
    const std::vector<VertexId> doubtful = doubtful_vertices(kVerticesPart * target);
    const std::vector<Edge> suspect = suspect_edges(edges, kEdgesPart * target);
    const std::size_t open = doubtful.size() + (full() ? 0 : suspect.size());
    if (open <= edges.size() / kFew) break;
    gather_at_doubtful(doubtful);
    split_suspects(suspect, target / double(edges.size()));
    transfer(true);
  }
  state_.indirect_mean_square = indirect_mean_square();
}

/// The vertices that should gather for interpolation at all others to cost no more than `budget`
/// (m²). Where the doubt comes from those that a vertex lies among, they gather first.
std::vector<VertexId> Gathering::doubtful_vertices(double budget) const {
  std::vector<std::pair<double, VertexId>> ranked;
  const std::vector<double> around = areas_around();
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    if (state_.light[v].gathers) continue;
    ranked.emplace_back(
        kMeanSquare * square(state_.light[v].bend / scale(v)) * around[v] * importance(v), v);
  }
  std::sort(ranked.begin(), ranked.end(), std::greater<>());
  const std::size_t n = worth_taking<VertexId>(ranked, budget);

  std::vector<VertexId> doubtful, open;
  std::vector<char> seen(state_.light.size());
  const auto visit = [&](VertexId v) {
    if (!seen[v]) open.push_back(v);
    seen[v] = 1;
  };
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const VertexId v = ranked[i].second;
    if (i < n || state_.light[v].bend > most_bend(v)) visit(v);
  }
  while (!open.empty()) {
    const VertexId v = open.back();
    open.pop_back();
    const VertexLight& light = state_.light[v];
    if (!mesh_.vertex(v).hidden && 2 * light.own_bend >= light.bend) {
      doubtful.push_back(v);
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId parent = light.among.vertices[k];
      if (light.among.weights[k] > 0 && state_.light[parent].bend > 0) visit(parent);
    }
  }
  std::sort(doubtful.begin(), doubtful.end());
  return doubtful;
}

/// The edges between gathering vertices in whose middle to gather, for the others to cost no more
/// than `budget` (m²).
std::vector<Edge> Gathering::suspect_edges(std::span<const Edge> edges, double budget) const {
  std::vector<std::pair<double, std::uint32_t>> ranked;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const Edge& e = edges[i];
    if (!state_.light[e.a].gathers || !state_.light[e.b].gathers) continue;
    if (state_.indirect_findings.contains(e.key())) continue;
    ranked.emplace_back(cost(e, state_.edge_scale * usual_bend(e.a, e.b)), i);
  }
  std::sort(ranked.begin(), ranked.end(), std::greater<>());
  const std::size_t n = worth_taking<std::uint32_t>(ranked, budget);
  std::vector<Edge> suspect;
  for (std::size_t i = 0; i < ranked.size(); ++i) {
    const Edge& e = edges[ranked[i].second];
    if (i < n || stands_out(e, usual_bend(e.a, e.b))) suspect.push_back(e);
  }
  return suspect;
}

double Gathering::most_bend(VertexId v) const {
  return kMostBend * leniency(v, area_around(v)) * state_.level * scale(v);
}

/// How much more may be wrong at a vertex whose triangles, of that area, are too small to stand
/// out.
double Gathering::leniency(VertexId v, double area) const {
  constexpr double kSmall = 0.01;  // of the room
  constexpr double kMost = 3;
  const double size = std::sqrt(area);
  return size > 0 ? std::clamp(std::sqrt(kSmall * extent(v) / size), 1.0, kMost) : kMost;
}

/// Whether an error e in the middle of an edge is worth a split even where the area is small.
bool Gathering::stands_out(const Edge& edge, double e) const {
  return std::abs(e) > std::max(most_bend(edge.a), most_bend(edge.b)) &&
         distance(mesh_.vertex(edge.a).position, mesh_.vertex(edge.b).position) >
             kFinest * mesh_.rules().max_edge * extent(edge.a) / diagonal_;
}

/// Gives the vertices links, and learns how right the rule for them was.
void Gathering::gather_at_doubtful(std::span<const VertexId> doubtful) {
  struct Before {
    VertexId vertex;
    Rgb indirect;
    double variance, rule, area;
  };
  std::vector<Before> by_rule;
  for (const VertexId v : doubtful) {
    const double rule = rule_bend(v);
    if (rule < state_.light[v].own_bend) continue;  // it is a glimpse that doubts
    const VertexLight& light = state_.light[v];
    by_rule.push_back({v, light.indirect, square(light.indirect_deviation), rule, area_around(v)});
  }
  trace_as_wanted(doubtful, wanted_grids(), trial_grid());
  std::vector<Finding> findings;
  for (const auto& [v, before, variance, rule, area] : by_rule) {
    const VertexLight& light = state_.light[v];
    const double chance = variance + square(light.indirect_deviation);
    const double found = square(luminance(light.indirect - before)) - chance;
    findings.push_back({square(rule) * area, found * area, chance * area});
  }
  learn(state_.bend_scale, std::move(findings));
}

/// Of the triangles at a vertex, m².
double Gathering::area_around(VertexId v) const {
  double area = 0;
  for (const TriangleId t : mesh_.vertex(v).triangles) area += mesh_.triangle(t).area;
  return area;
}

/// The same of all vertices.
std::vector<double> Gathering::areas_around() const {
  std::vector<double> areas(state_.light.size());
  for (const Triangle& triangle : mesh_.triangles()) {
    if (!triangle.alive) continue;
    for (const VertexId v : triangle.vertices) areas[v] += triangle.area;
  }
  return areas;
}

/// Sets a rule right by what was found. What was not looked at is more like those of which less was
/// foreseen: they tell, one half of all that was.
void Gathering::learn(double& rule_scale, std::vector<Finding> findings) {
  constexpr std::size_t kFewest = 16;
  constexpr double kMargin = 1.3, kSure = 0.5;
  if (findings.size() < kFewest) return;
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.foreseen < b.foreseen; });
  double all = 0, foreseen = 0, found = 0, noise = 0;
  for (const Finding& f : findings) all += f.foreseen;
  for (const Finding& f : findings) {
    if (foreseen > all / 2) break;
    foreseen += f.foreseen, found += f.found, noise += square(f.noise);
  }
  if (!(foreseen > 0)) return;
  // The square of something normal has twice the square of its variance as its own. As far as that
  // hides what was found, the rule stays.
  const double unsure = 2 * noise / square(kSure * foreseen);
  const double ratio = (std::max(0.0, kMargin * found / foreseen) + unsure) / (1 + unsure);
  // Half of the way, since what is looked at from one round to the next is not alike.
  const double factor = std::sqrt(std::sqrt(ratio));
  rule_scale = std::clamp(rule_scale * std::clamp(factor, 0.7, 1.4), 0.1, 1.5);
}

void Gathering::split_suspects(std::span<const Edge> suspect, double allowed) {
  const std::vector<Middle> middles = middles_of(suspect);
  const std::vector<int> wanted = wanted_grids();
  std::vector<RowRequest> requests;
  std::vector<std::size_t> of;  // the suspects
  for (std::size_t i = 0; i < suspect.size(); ++i) {
    if (!middles[i].point) continue;
    const auto& [a, b, area] = suspect[i];
    const int grid = std::min(std::max(wanted[a], wanted[b]), trial_grid());
    of.push_back(i);
    requests.push_back(
        {{middles[i].point->position, middles[i].point->normal}, grid, suspect[i].key()});
  }
  std::vector<TracedRow> rows(suspect.size());
  trace_rows(requests, [&](std::size_t i, TracedRow row) { rows[of[i]] = std::move(row); });
  light_sites();
  std::vector<Gathered> gathered(suspect.size());
  std::vector<std::size_t> costly;
  std::vector<Edge> to_split;
  std::vector<Finding> findings;
  double found = 0, foreseen = 0;
  for (std::size_t i = 0; i < suspect.size() && !stopped_; ++i) {
    const Edge& edge = suspect[i];
    if (rows[i].links.empty()) {
      state_.indirect_findings[edge.key()] = {};
      continue;
    }
    gathered[i] = gather(rows[i]);
    const VertexLight &a = state_.light[edge.a], &b = state_.light[edge.b];
    const double e = luminance((a.indirect + b.indirect) / 2 - gathered[i].irradiance);
    const double noise = square(gathered[i].error) +
                         (square(a.indirect_deviation) + square(b.indirect_deviation)) / 4;
    const double rule = square(state_.edge_scale * usual_bend(edge.a, edge.b));
    state_.indirect_findings[edge.key()] = {static_cast<float>(e),
                                            static_cast<float>(std::sqrt(noise))};
    findings.push_back({rule * edge.area, (e * e - noise) * edge.area, noise * edge.area});
    const double weight = edge.area * (importance(edge.a) + importance(edge.b));
    found += e * weight;
    foreseen += std::sqrt(rule) * weight;
  }
  learn_lean(found, foreseen);
  learn(state_.edge_scale, std::move(findings));
  for (std::size_t i = 0; i < suspect.size() && !stopped_; ++i) {
    if (rows[i].links.empty()) continue;
    const double likely = likely_indirect_error(suspect[i]);
    if (cost(suspect[i], likely) <= allowed && !stands_out(suspect[i], likely)) continue;
    costly.push_back(i);
    to_split.push_back(suspect[i]);
  }

  const std::vector<Edge> longer = longer_sides(to_split);
  split(longer, middles_of(longer));
  glimpse();
  for (const std::size_t i : costly) {
    const std::size_t v = mesh_.vertices().size();
    split({&suspect[i], 1}, {&middles[i], 1});
    if (mesh_.vertices().size() == v) continue;
    VertexLight& light = state_.light[v];
    give_links(static_cast<VertexId>(v), std::move(rows[i]));
    light.indirect = gathered[i].irradiance;
    light.indirect_deviation = gathered[i].error;
    sum_up(static_cast<VertexId>(v));
  }
}

/// e of E_i in the middle of an edge. Where it was looked at: less than was found as far as noise
/// hides it, the rule telling how much is to be expected. Else as a rule, taken to be positive; or
/// what interpolating E_i at its ends costs.
Gathering::EdgeError Gathering::indirect_error(const Edge& e) const {
  const VertexLight &a = state_.light[e.a], &b = state_.light[e.b];
  const auto found = state_.indirect_findings.find(e.key());
  if (found == state_.indirect_findings.end()) {
    if (a.gathers && b.gathers) return {state_.edge_scale * usual_bend(e.a, e.b)};
    return {(a.bend + b.bend) / 2};
  }
  const double rule = square(state_.edge_scale * usual_bend(e.a, e.b));
  const double noise = square(found->second.deviation);
  if (rule == 0) return {};
  return {found->second.error * rule / (rule + noise), rule * noise / (rule + noise)};
}

/// The same with its sign. Where nobody looked: as findings lean on the whole.
double Gathering::likely_indirect_error(const Edge& e) const {
  const double lean = state_.indirect_findings.contains(e.key()) ? 1 : state_.lean;
  return lean == 0 ? 0 : lean * indirect_error(e).likely;
}

/// How findings lean, of which these are new: what was found, signs and all, in parts of what the
/// rule foresaw (m² lx). Known only where light leaves the scene: else the balance sets right what
/// interpolation loses.
void Gathering::learn_lean(double found, double foreseen) {
  constexpr double kKept = 0.5;
  if (closed_) {
    state_.found = state_.foreseen = state_.lean = 0;
    return;
  }
  state_.found = kKept * state_.found + found;
  state_.foreseen = kKept * state_.foreseen + foreseen;
  state_.lean = state_.foreseen > 0 ? std::clamp(state_.found / state_.foreseen, -1.0, 1.0) : 0;
}

/// What interpolation of E_i costs, relative.
double Gathering::indirect_mean_square() const {
  return mean_square([&](const Edge& e) {
    const auto [likely, variance] = indirect_error(e);
    return EdgeError{likely / scale(e), variance / square(scale(e))};
  });
}

}  // namespace isolux
