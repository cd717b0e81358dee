#include "isolux/radiosity/gathering.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "isolux/core/error.h"
#include "isolux/core/parallel.h"
#include "isolux/discretization/cover.h"
#include "isolux/discretization/living_edges.h"
#include "isolux/discretization/split_points.h"
#include "isolux/radiosity/direct_light.h"
#include "isolux/radiosity/energy.h"
#include "isolux/radiosity/hemisphere_gather.h"
#include "isolux/radiosity/illumination.h"
#include "isolux/radiosity/spatial_order.h"
#include "isolux/radiosity/stopwatch.h"

namespace isolux {

// Notation
//   E = E_d + E_i    irradiance, lx: straight from the lights, and by reflection
//   σ                standard deviation of a gathered value's luminance, lx
//   e                error of linear interpolation in the middle of an edge, lx
//   τ                the tolerance

namespace {

// How the tolerance is shared out among its sources; the squares add up to less than 1.
constexpr double kDirectShare = 0.55;   // interpolation of E_d
constexpr double kIndirectShare = 0.4;  // interpolation of E_i
constexpr double kSamplingShare = 0.5;  // σ of E_i
constexpr double kUnshotShare = 0.02;   // light not yet passed on
constexpr double kRenewalShare = 0.1;   // what a row of links may gain from the mesh's refinement

// The first solution is this rough, each next one finer by up to this factor.
constexpr double kFirstTolerance = 0.08;
constexpr double kLevelRatio = 8;

// A round of splits takes on the worst edges, which make up this part of the estimated error
// squared: the bulk criterion of Dörfler (1996).
constexpr double kBulk = 0.7;

// Of a linear function's error squared over a triangle, as a mean: 8/45 (Σ e² + Σ e e') for the
// errors e in the middles of its sides, quadratic between them; at most this times Σ e².
constexpr double kMeanSquare = 16.0 / 45;

// E_i in the middle of an edge is off its ends' mean by this part of their difference, as a rule.
constexpr double kUsualBend = 0.2;
// Or by this part of E_i where what is seen is as close as half the edge is long.
constexpr double kUsualCurve = 0.25;

// Rays over a hemisphere: cells a side.
constexpr int kCoarsestGrid = 8;

// What a triangle sends is right in the mean for light that is quadratic along its sides; of the
// error that linear interpolation would make, this part may be left.
constexpr double kBiasLeft = 0.25;

class Gathering {
 public:
  Gathering(GatheringState& state, const RayCaster& rays, const Options& options,
            const GatheringCallbacks& callbacks)
      : state_(state),
        mesh_(state.mesh),
        rays_(rays),
        options_(options),
        callbacks_(callbacks),
        lights_(rays) {}

  /// Procedure Radiosity (§3.2.1), by gathering.
  void run() {
    if (mesh_.vertices().empty()) first_solution();
    for (; keep_going(); ++state_.statistics.iterations) {
      refine_direct();
      gather_all(grid_for(state_.level));
      transfer();
      refine_indirect();
      transfer();
      estimate();
      if (stopped_ || !next_level() || full()) break;
    }
    finish();
  }

 private:
  static constexpr std::size_t kChunk = 8192;  // work between two looks at the clock
  static constexpr std::size_t kGrain = 256;

  /// Covers all surfaces and lights them roughly.
  void first_solution() {
    CoverOptions cover_options;
    cover_options.spacing = mesh_.rules().max_edge / 2;
    cover_options.seed = options_.seed;
    cover(mesh_, rays_, cover_options);
    light_newborn();
    state_.statistics.emitted_flux = emitted_flux();
    state_.level = std::max(options_.tolerance, kFirstTolerance);
    gather_all(kCoarsestGrid);
    transfer();
    estimate();
  }

  /// Of all objects, lm: of those whose area is not known, as the cover has them.
  double emitted_flux() const {
    const auto& objects = rays_.scene().objects;
    std::vector<char> area_known;
    double flux = 0;
    for (const Object& object : objects) {
      area_known.push_back(!object.emits() || surface_area(*object.shape));
      flux += luminous_flux(object);
    }
    for (const Triangle& triangle : mesh_.triangles()) {
      const std::uint32_t object = mesh_.vertex(triangle.vertices[0]).surface.object;
      if (!triangle.alive || area_known[object]) continue;
      flux += luminance(triangle.emission) * triangle.area;
    }
    return flux;
  }

  /// Goes on to a stricter level; false where the goal is reached, or out of reach.
  bool next_level() {
    constexpr int kMostTries = 6;
    constexpr double kTighter = 0.7;
    state_.statistics.converged = state_.statistics.error <= options_.tolerance;
    if (state_.statistics.converged) return false;
    if (state_.level > options_.tolerance) {
      state_.level = std::max(options_.tolerance, state_.level / kLevelRatio);
      return true;
    }
    state_.level *= kTighter;
    return ++state_.tries < kMostTries;
  }

  bool full() const {
    return options_.max_triangles > 0 && mesh_.triangle_count() >= options_.max_triangles;
  }

  /// Asks the caller whether to go on; once it is refused, it stays refused.
  bool keep_going() {
    if (!stopped_ && callbacks_.progress) {
      const double seconds = stopwatch_.wall();
      const auto ray_count =
          double(state_.statistics.refinement_rays + state_.statistics.shadow_rays);
      stopped_ = !callbacks_.progress({state_.statistics.iterations, 0, state_.statistics.error,
                                       unshot_part(), mesh_.triangle_count(),
                                       ray_count / std::max(seconds, 1e-9), 0});
    }
    return !stopped_;
  }

  double unshot_part() const {
    return state_.statistics.emitted_flux > 0
               ? state_.statistics.unshot_flux / state_.statistics.emitted_flux
               : 1;
  }

  /// Calls body(begin, end) for pieces of 0 … n − 1 on several threads, until told to stop. Returns
  /// how many were done, from the first on.
  template <typename Body>
  std::size_t for_pieces(std::size_t n, Body&& body) {
    std::size_t done = 0;
    while (done < n && keep_going()) {
      const std::size_t first = done, count = std::min(kChunk, n - first);
      parallel_for(count, kGrain,
                   [&](std::size_t begin, std::size_t end) { body(first + begin, first + end); });
      done += count;
    }
    return done;
  }

  // Direct light ------------------------------------------------------------------------------

  /// E_d of the vertices that have none yet.
  void light_newborn() {
    const std::size_t first = state_.light.size(), n = mesh_.vertices().size();
    state_.light.resize(n);
    state_.sent.resize(n);
    std::vector<Vec3> points;
    for (std::size_t v = first; v < n; ++v) points.push_back(mesh_.vertex(VertexId(v)).position);
    const std::vector<std::uint32_t> order = z_order(points);
    std::vector<Receiver> receivers;
    for (std::uint32_t i : order) {
      const Vertex& vertex = mesh_.vertex(static_cast<VertexId>(first + i));
      receivers.push_back({vertex.gather_point, vertex.normal});
    }
    std::vector<Rgb> irradiance(order.size());
    std::vector<double> deviation(order.size());
    lights_.irradiance(receivers, irradiance, deviation);
    for (std::size_t i = 0; i < order.size(); ++i) {
      VertexLight& light = state_.light[first + order[i]];
      light.direct = irradiance[i];
      light.direct_deviation = deviation[i];
    }
    for (std::size_t v = first; v < n; ++v) sum_up(VertexId(v));
  }

  Rgb irradiance(VertexId v) const { return state_.light[v].direct + state_.light[v].indirect; }

  /// What a vertex sends follows from what it has.
  void sum_up(VertexId v) {
    const Rgb e = irradiance(v);
    const double l = luminance(e);
    state_.sent[v] = l > 0 ? e * std::clamp(1 - state_.light[v].excess / l, 0.3, 1.7) : e;
  }

  struct Middle {
    std::optional<SurfacePoint> point;
    Rgb direct;
    double deviation = 0;
  };

  /// The surface over the middles of `chosen` edges, and E_d there.
  void light_middles(std::span<const Edge> edges, std::span<const std::uint32_t> chosen,
                     std::span<Middle> middles) {
    parallel_for(chosen.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Edge& edge = edges[chosen[i]];
        middles[chosen[i]].point = point_over_edge(mesh_, rays_, edge.a, edge.b);
      }
    });
    std::vector<Receiver> receivers;
    std::vector<std::uint32_t> of;
    for (std::uint32_t i : chosen) {
      if (!middles[i].point) continue;
      receivers.push_back({middles[i].point->position, middles[i].point->normal});
      of.push_back(i);
    }
    std::vector<Rgb> irradiance(of.size());
    std::vector<double> deviation(of.size());
    lights_.irradiance(receivers, irradiance, deviation);
    for (std::size_t i = 0; i < of.size(); ++i) {
      middles[of[i]].direct = irradiance[i];
      middles[of[i]].deviation = deviation[i];
    }
  }

  /// The surface over the middles of edges, and E_d there.
  std::vector<Middle> middles_of(std::span<const Edge> edges) {
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
  double direct_error(const Edge& edge, const Middle& middle) const {
    if (!middle.point) return 0;
    const VertexLight &a = state_.light[edge.a], &b = state_.light[edge.b];
    const double e = luminance((a.direct + b.direct) / 2 - middle.direct);
    const double noise =
        middle.deviation * middle.deviation +
        (a.direct_deviation * a.direct_deviation + b.direct_deviation * b.direct_deviation) / 4;
    return std::copysign(std::sqrt(std::max(0.0, e * e - noise)), e);
  }

  /// Splits edges until interpolation of E_d costs no more than its share.
  void refine_direct() {
    while (!stopped_) {
      mesh_.compact();
      if (callbacks_.checkpoint) callbacks_.checkpoint(state_);
      const std::vector<Edge> edges = living_edges(mesh_);
      sample(edges);
      const double target = square(kDirectShare * state_.level * mean_irradiance());
      const double total = direct_mean_square(edges);
      state_.direct_mean_square = total;
      if (stopped_ || total <= target || full()) return;
      const std::size_t before = mesh_.vertices().size();
      split_worst(edges, total, target);
      if (mesh_.vertices().size() == before) return;
    }
  }

  /// E_d in the middles of edges that were not looked at yet.
  void sample(std::span<const Edge> edges) {
    if (state_.direct_error.size() > 3 * edges.size()) {
      std::unordered_map<std::uint64_t, float> living;
      for (const Edge& e : edges) {
        if (const auto at = state_.direct_error.find(e.key()); at != state_.direct_error.end())
          living.insert(*at);
      }
      state_.direct_error.swap(living);
    }
    std::vector<Edge> fresh;
    for (const Edge& e : edges) {
      if (!state_.direct_error.contains(e.key())) fresh.push_back(e);
    }
    const std::vector<Middle> middles = middles_of(fresh);
    if (stopped_) return;
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      state_.direct_error[fresh[i].key()] = static_cast<float>(direct_error(fresh[i], middles[i]));
    }
  }

  static double square(double x) { return x * x; }

  double weight(const Edge& edge, double e) const { return kMeanSquare * e * e * edge.area; }

  double direct_mean_square(std::span<const Edge> edges) {
    double sum = 0, bias = 0;
    for (const Edge& e : edges) {
      const auto at = state_.direct_error.find(e.key());
      if (at == state_.direct_error.end()) continue;
      sum += weight(e, at->second);
      bias += at->second * e.area / 3;
    }
    state_.bias = bias / area();
    return sum / area();
  }

  /// Splits the edges that the bulk criterion names.
  void split_worst(std::span<const Edge> edges, double total, double target) {
    std::vector<std::pair<double, std::uint32_t>> ranked;
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      const double cost = weight(edges[i], state_.direct_error.at(edges[i].key())) / area();
      if (cost > 0) ranked.emplace_back(-cost, i);
    }
    std::sort(ranked.begin(), ranked.end());
    // Splits leave about a tenth of an edge's cost behind; there is no need to go below the target.
    const double enough = std::min(kBulk * total, 1.1 * (total - target));
    double taken = 0;
    std::vector<Edge> worst;
    for (const auto& [cost, i] : ranked) {
      if (taken >= enough) break;
      taken -= cost;
      worst.push_back(edges[i]);
    }
    split(worst, middles_of(worst));
  }

  /// Makes the middles vertices; E_i is interpolated.
  void split(std::span<const Edge> edges, std::span<const Middle> middles) {
    for (std::size_t i = 0; i < edges.size() && !full() && !stopped_; ++i) {
      const auto& [a, b, area] = edges[i];
      if (!middles[i].point) continue;
      const std::optional<VertexId> v = mesh_.split_edge(a, b, *middles[i].point);
      if (!v) {
        state_.direct_error[edges[i].key()] = 0;  // stays as it is: nothing to gain here
        continue;
      }
      ++state_.statistics.split;
      split_since_[edges[i].key()] =
          static_cast<float>(std::abs(signed_error(state_.direct_error, edges[i]) +
                                      signed_error(state_.indirect_error, edges[i])));
      state_.light.resize(mesh_.vertices().size());
      state_.sent.resize(mesh_.vertices().size());
      VertexLight& light = state_.light[*v];
      light.direct = middles[i].direct;
      light.direct_deviation = middles[i].deviation;
      light.parents = {a, b};
      interpolate_indirect(*v);
      sum_up(*v);
    }
  }

  void interpolate_indirect(VertexId v) {
    VertexLight& light = state_.light[v];
    const VertexLight &a = state_.light[light.parents[0]], &b = state_.light[light.parents[1]];
    light.indirect = (a.indirect + b.indirect) / 2;
    light.indirect_deviation = (a.indirect_deviation + b.indirect_deviation) / 2;
    light.escaped = (a.escaped + b.escaped) / 2;
    light.closeness = (a.closeness + b.closeness) / 2;
    light.bend = (a.bend + b.bend) / 2 + usual_bend(light.parents[0], light.parents[1]);
  }

  /// How far apart E_i of two vertices is, what chance adds left out.
  double difference(VertexId v, VertexId w) const {
    const VertexLight &a = state_.light[v], &b = state_.light[w];
    const double noise = square(a.indirect_deviation) + square(b.indirect_deviation);
    return std::sqrt(std::max(0.0, square(luminance(a.indirect - b.indirect)) - noise));
  }

  /// How far E_i in the middle between two vertices is off their mean, as a rule: a part of their
  /// difference, or, where things stand close to them, the square of distances' ratio: the radius
  /// of irradiance caching (Ward, Rubinstein and Clear 1988) is the harmonic mean distance.
  double usual_bend(VertexId v, VertexId w) const {
    const VertexLight &a = state_.light[v], &b = state_.light[w];
    const double ratio = distance(mesh_.vertex(v).position, mesh_.vertex(w).position) *
                         (a.closeness + b.closeness) / 4;
    const double mean = luminance(a.indirect + b.indirect) / 2;
    return std::max(kUsualBend * difference(v, w),
                    kUsualCurve * mean * std::min(1.0, ratio * ratio));
  }

  // Indirect light ----------------------------------------------------------------------------

  /// The grid of rays that keeps σ within its share: from the last σ seen, which falls about as the
  /// number of rays to the power of −3/4.
  int grid_for(double level) const {
    const double wanted = kSamplingShare * level * mean_irradiance();
    if (!(state_.deviation > wanted)) return state_.grid;
    return static_cast<int>(
        std::min<double>(std::ceil(state_.grid * std::pow(state_.deviation / wanted, 2.0 / 3)),
                         HemisphereGather::kFinestGrid));
  }

  /// New links for the vertices that gather, grid² rays each, over the mesh as it is now.
  void gather_all(int grid) {
    state_.grid = grid;
    look_up_anew();
    std::vector<VertexId> gatherers;
    for (VertexId v = 0; v < state_.light.size(); ++v) {
      const bool in_cover = state_.light[v].parents[0] == state_.light[v].parents[1];
      if (state_.light[v].gathers() || in_cover) gatherers.push_back(v);
    }
    trace(gatherers);
  }

  std::vector<Landing> links(const Receiver& receiver, std::uint64_t id) const {
    std::vector<Landing> row(square_of(state_.grid));
    hemisphere_->trace(receiver, state_.grid, options_.seed, id, row);
    return row;
  }

  /// Gives the vertices links of their own.
  void trace(std::span<const VertexId> vertices) {
    std::vector<Vec3> places;
    for (VertexId v : vertices) places.push_back(mesh_.vertex(v).position);
    const std::vector<std::uint32_t> order = z_order(places);
    for_pieces(vertices.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const VertexId v = vertices[order[i]];
        const Vertex& vertex = mesh_.vertex(v);
        give_links(v, links({vertex.gather_point, vertex.normal}, v));
      }
    });
    state_.statistics.refinement_rays += vertices.size() * square_of(state_.grid);
  }

  void give_links(VertexId v, std::vector<Landing> row) {
    VertexLight& light = state_.light[v];
    light.escaped = hemisphere_->escaped(row);
    light.closeness = 0;
    for (const Landing& landing : row) {
      const double away = distance(mesh_.vertex(v).position, place_of(landing));
      if (away > 0) light.closeness += 1 / away / static_cast<double>(row.size());
    }
    light.bend = 0;
    light.row = std::move(row);
  }

  /// Where a ray landed.
  Vec3 place_of(const Landing& landing) const {
    const auto [w1, w2] = landing.weight();
    const auto& [a, b, c] = landing.vertices;
    return mesh_.vertex(a).position * (1 - w1 - w2) + mesh_.vertex(b).position * w1 +
           mesh_.vertex(c).position * w2;
  }

  /// E_i of a vertex with links, under the light of the moment.
  void evaluate(VertexId v) {
    const Gathered gathered = hemisphere_->gather_with_error(state_.light[v].row, state_.sent);
    state_.light[v].indirect = gathered.irradiance;
    state_.light[v].indirect_deviation = gathered.error;
  }

  /// The mean of the errors `e` of edges around each vertex, by area, so that the sum over the
  /// whole mesh is right.
  template <typename Error>
  std::vector<double> around_vertices(std::span<const Edge> edges, Error&& error) const {
    std::vector<double> sum(state_.light.size()), area(state_.light.size());
    for (const Edge& e : edges) {
      for (const VertexId v : {e.a, e.b}) sum[v] += error(e) * e.area, area[v] += e.area;
    }
    for (std::size_t v = 0; v < sum.size(); ++v) {
      if (area[v] > 0) sum[v] /= area[v];
    }
    return sum;
  }

  /// By how much interpolation is too bright around each vertex.
  void find_excess() {
    const std::vector<Edge> edges = living_edges(mesh_);
    indirect_excess_ = around_vertices(
        edges, [&](const Edge& e) { return signed_error(state_.indirect_error, e); });
    const std::vector<double> direct_excess =
        around_vertices(edges, [&](const Edge& e) { return signed_error(state_.direct_error, e); });
    for (VertexId v = 0; v < state_.light.size(); ++v) {
      state_.light[v].excess = direct_excess[v] + indirect_excess_[v];
      sum_up(v);
    }
  }

  static double signed_error(const std::unordered_map<std::uint64_t, float>& errors,
                             const Edge& e) {
    const auto at = errors.find(e.key());
    return at == errors.end() ? 0 : at->second;
  }

  /// Passes the light on along the links, sweep by sweep, until little is unshot.
  void transfer() {
    find_excess();
    constexpr int kMostSweeps = 10'000;
    const double enough = kUnshotShare * state_.level;
    std::vector<VertexId> gatherers;
    for (VertexId v = 0; v < state_.light.size(); ++v) {
      if (state_.light[v].gathers()) gatherers.push_back(v);
    }
    for (int sweep = 0; sweep < kMostSweeps && keep_going(); ++sweep) {
      const std::vector<Rgb> old = state_.sent;
      parallel_for(gatherers.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) evaluate(gatherers[i]);
      });
      for (VertexId v = 0; v < state_.light.size(); ++v) {
        if (!state_.light[v].gathers()) interpolate_indirect(v);
      }
      balance_indirect();
      for (VertexId v = 0; v < state_.light.size(); ++v) sum_up(v);
      settle_energy(old);
      if (state_.statistics.unshot_flux <= enough * state_.statistics.emitted_flux) break;
      add_ambient(old);
    }
  }

  /// In a closed scene all that is sent arrives: where interpolation gives a little more or less,
  /// E_i is put right as a whole.
  void balance_indirect() {
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
    const auto ratio = [](double a, double b) { return b > 0 ? std::clamp(a / b, 0.9, 1.1) : 1; };
    const Rgb factor{ratio(sent.r, received.r), ratio(sent.g, received.g),
                     ratio(sent.b, received.b)};
    for (VertexLight& light : state_.light) light.indirect = light.indirect * factor;
  }

  /// The balance after a sweep that began with the irradiances `old`.
  void settle_energy(std::span<const Rgb> old) {
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
  void add_ambient(std::span<const Rgb> old) {
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

  /// Lets vertices gather, and splits edges, where interpolation of E_i costs too much.
  void refine_indirect() {
    const double target = square(kIndirectShare * state_.level * mean_irradiance()) * area();
    state_.indirect_error.clear();
    for (int round = 0; round < 12 && !stopped_; ++round) {
      const std::vector<Edge> edges = living_edges(mesh_);
      std::vector<double> around(state_.light.size());  // area of the triangles at each vertex
      for (const Edge& e : edges) around[e.a] += e.area / 2, around[e.b] += e.area / 2;
      const double allowed = target / double(edges.size());

      std::vector<VertexId> doubtful;
      for (VertexId v = 0; v < state_.light.size(); ++v) {
        if (!state_.light[v].gathers() &&
            kMeanSquare * square(state_.light[v].bend) * around[v] > allowed)
          doubtful.push_back(v);
      }
      std::vector<Edge> suspect;
      for (const Edge& e : edges) {
        if (!state_.light[e.a].gathers() || !state_.light[e.b].gathers() ||
            state_.indirect_error.contains(e.key()))
          continue;
        if (weight(e, state_.bend_scale * usual_bend(e.a, e.b)) > allowed) suspect.push_back(e);
      }
      if (doubtful.empty() && (suspect.empty() || full())) break;
      trace(doubtful);
      parallel_for(doubtful.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (state_.light[doubtful[i]].gathers()) evaluate(doubtful[i]);
        }
      });
      for (VertexId v : doubtful) sum_up(v);
      split_suspects(suspect, allowed);
      renew_links();
      transfer();
    }
    state_.indirect_mean_square = indirect_mean_square();
  }

  /// Links anew the vertices whose rays landed on edges that are split since, where this matters:
  /// the mesh knows the light there better now.
  void renew_links() {
    if (split_since_.empty()) return;
    const double matters = kRenewalShare * state_.level * mean_irradiance();
    const auto gain = [&](const Landing& landing) {
      double most = 0;
      for (int k = 0; k < 3; ++k) {
        const auto [a, b] = std::minmax(landing.vertices[k], landing.vertices[(k + 1) % 3]);
        const auto split = split_since_.find(Edge{a, b}.key());
        if (split != split_since_.end()) most = std::max(most, double(split->second));
      }
      return most > 0 ? most * luminance(mesh_.vertex(landing.vertices[0]).reflectance) / 2 : 0;
    };
    std::vector<char> renew(state_.light.size());
    parallel_for(renew.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const std::vector<Landing>& row = state_.light[v].row;
        double sum = 0;
        for (const Landing& landing : row) sum += gain(landing);
        renew[v] = sum > matters * static_cast<double>(row.size());
      }
    });
    std::vector<VertexId> vertices;
    for (VertexId v = 0; v < renew.size(); ++v) {
      if (renew[v]) vertices.push_back(v);
    }
    look_up_anew();
    trace(vertices);
  }

  /// Landings from here on are looked up in the mesh as it is now.
  void look_up_anew() {
    hemisphere_.emplace(rays_, mesh_, lights_.separate());
    split_since_.clear();
  }

  void split_suspects(std::span<const Edge> suspect, double allowed) {
    const std::vector<Middle> middles = middles_of(suspect);
    std::vector<std::vector<Landing>> rows(suspect.size());
    for_pieces(suspect.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!middles[i].point) continue;
        rows[i] = links({middles[i].point->position, middles[i].point->normal}, suspect[i].key());
      }
    });
    state_.statistics.refinement_rays += suspect.size() * square_of(state_.grid);
    double foreseen = 0, found = 0;
    for (std::size_t i = 0; i < suspect.size() && !stopped_; ++i) {
      const Edge& edge = suspect[i];
      foreseen += weight(edge, usual_bend(edge.a, edge.b));
      if (rows[i].empty()) {
        state_.indirect_error[edge.key()] = 0;
        continue;
      }
      const Gathered gathered = hemisphere_->gather_with_error(rows[i], state_.sent);
      const VertexLight &a = state_.light[edge.a], &b = state_.light[edge.b];
      const double e = luminance((a.indirect + b.indirect) / 2 - gathered.irradiance);
      const double noise = square(gathered.error) +
                           (square(a.indirect_deviation) + square(b.indirect_deviation)) / 4;
      const double clean = std::sqrt(std::max(0.0, e * e - noise));
      state_.indirect_error[edge.key()] = static_cast<float>(std::copysign(clean, e));
      found += weight(edge, clean);
      if (weight(edge, clean) <= allowed) continue;
      const std::size_t v = mesh_.vertices().size();
      split({&edge, 1}, {&middles[i], 1});
      if (mesh_.vertices().size() == v) continue;
      VertexLight& light = state_.light[v];
      give_links(static_cast<VertexId>(v), std::move(rows[i]));
      light.indirect = gathered.irradiance;
      light.indirect_deviation = gathered.error;
      sum_up(static_cast<VertexId>(v));
    }
    if (foreseen > 0) {
      state_.bend_scale = std::clamp(1.5 * std::sqrt(found / foreseen), 0.2, 1.0);
    }
  }

  /// e of E_i in the middle of an edge: as it was found, or as a rule.
  double indirect_error(const Edge& e) const {
    const auto known = state_.indirect_error.find(e.key());
    const double bend = known != state_.indirect_error.end()
                            ? std::abs(known->second)
                            : state_.bend_scale * usual_bend(e.a, e.b);
    return bend + (state_.light[e.a].bend + state_.light[e.b].bend) / 2;
  }

  /// What interpolation of E_i costs, lx².
  double indirect_mean_square() const {
    double sum = 0;
    for (const Edge& e : living_edges(mesh_)) sum += weight(e, indirect_error(e));
    return sum / area();
  }

  // Errors ------------------------------------------------------------------------------------

  double area() const { return state_.statistics.mesh_area; }

  double mean_irradiance() const { return state_.statistics.mean_irradiance; }

  double variance_of(VertexId v) const {
    const VertexLight& light = state_.light[v];
    return square(light.direct_deviation) + square(light.indirect_deviation);
  }

  /// The errors of all vertices, and of the whole.
  void estimate() {
    double variance = 0, reflectance = 0, escaped = 0, total = 0;
    for (const Triangle& triangle : mesh_.triangles()) {
      if (!triangle.alive) continue;
      for (VertexId v : triangle.vertices) {
        const double part = triangle.area / 3;
        variance += variance_of(v) * part;
        reflectance += luminance(mesh_.vertex(v).reflectance) * part;
        escaped += state_.light[v].escaped * part;
        total += part;
      }
    }
    if (!(total > 0 && mean_irradiance() > 0)) return;
    state_.deviation = std::sqrt(variance / total);
    // What the emitters have too much or too little of all gather alike, once for every reflection.
    const double again = reflectance / total * (1 - escaped / total);
    const double unshot = state_.statistics.unshot_flux / total;
    state_.statistics.emitter_error =
        (kBiasLeft * again * std::abs(state_.bias) + unshot) / (1 - again);
    const double interpolation = std::sqrt(state_.direct_mean_square + state_.indirect_mean_square);
    state_.statistics.discretization_error = interpolation / mean_irradiance();
    state_.statistics.sampling_error = state_.deviation / mean_irradiance();
    state_.statistics.error =
        (std::hypot(interpolation, state_.deviation) + state_.statistics.emitter_error) /
        mean_irradiance();
  }

  /// What goes with the solution.
  void finish() {
    const std::vector<double> interpolation =
        around_vertices(living_edges(mesh_), [&](const Edge& e) {
          return std::abs(signed_error(state_.direct_error, e)) + indirect_error(e);
        });
    for (VertexId v = 0; v < state_.light.size(); ++v) {
      Vertex& vertex = mesh_.vertex(v);
      vertex.irradiance = irradiance(v);
      vertex.mean_irradiance = state_.sent[v];
      vertex.error = kConfidence * std::sqrt(variance_of(v) + square(state_.light[v].bend)) +
                     interpolation[v] + state_.statistics.emitter_error;
    }
    for (Triangle& triangle : mesh_.triangles()) {
      if (!triangle.alive) continue;
      triangle.shot = {};
      triangle.shot = unshot_radiosity(mesh_, triangle);
    }
    state_.statistics.interrupted = stopped_;
    state_.statistics.gather_rays = static_cast<int>(square_of(state_.grid));
    state_.statistics.gatherers = 0;
    for (const VertexLight& light : state_.light) state_.statistics.gatherers += light.gathers();
    state_.statistics.triangles = mesh_.triangle_count();
    state_.statistics.vertices = mesh_.vertices().size();
    state_.statistics.cpu_seconds = stopwatch_.cpu();
    state_.statistics.wall_seconds = stopwatch_.wall();
  }

  static std::uint64_t square_of(int n) {
    return static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(n);
  }

  GatheringState& state_;
  Triangulation& mesh_;
  const RayCaster& rays_;
  const Options& options_;
  const GatheringCallbacks& callbacks_;
  const Stopwatch stopwatch_;
  const DirectLight lights_;
  std::optional<HemisphereGather> hemisphere_;  // over the mesh as it was at the last gather_all()
  std::unordered_map<std::uint64_t, float> split_since_;  // edges split since then, and their |e|
  std::vector<double> indirect_excess_;                   // by vertex, lx: of the errors of E_i
  bool stopped_ = false;
};

}  // namespace

Rules gathering_rules(const Scene& scene) {
  constexpr double kLongestEdges = 8.5;  // across the scene
  const double size = scene.bounds().diagonal();
  Rules rules;
  rules.max_edge = size / kLongestEdges;
  rules.min_area = 1e-14 * size * size;
  return rules;
}

void gather_radiosity(GatheringState& state, const RayCaster& rays, const Options& options,
                      const GatheringCallbacks& callbacks) {
  const auto& objects = rays.scene().objects;
  if (std::none_of(objects.begin(), objects.end(), [](const Object& o) { return o.emits(); })) {
    throw InputError("the scene has no light: give an object an 'emission'");
  }
  Gathering(state, rays, options, callbacks).run();
}

}  // namespace isolux
