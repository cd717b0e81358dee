#pragma once

#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "isolux/core/parallel.h"
#include "isolux/discretization/coarsen.h"
#include "isolux/discretization/living_edges.h"
#include "isolux/radiosity/direct_light.h"
#include "isolux/radiosity/gathering_state.h"
#include "isolux/radiosity/hemisphere_gather.h"
#include "isolux/radiosity/options.h"
#include "isolux/radiosity/stopwatch.h"

namespace isolux {

// Notation
//   E = E_d + E_i    irradiance, lx: straight from the lights, and by reflection
//   σ                standard deviation of a gathered value's luminance, lx
//   e                error of linear interpolation in the middle of an edge, lx
//   τ                the tolerance

/// One run of gather_radiosity(): the procedure in gathering.cpp, the refinement for E_d in
/// gathering_direct.cpp, what surrounds a vertex in
/// gathering_surroundings.cpp, what lies hidden in gathering_hidden.cpp, links for E_i in
/// gathering_rays.cpp, its transfer in gathering_transfer.cpp, and its refinement in
/// gathering_indirect.cpp.
class Gathering {
 public:
  Gathering(GatheringState& state, const RayCaster& rays, const Options& options,
            const GatheringCallbacks& callbacks);

  /// Procedure Radiosity (§3.2.1), by gathering.
  void run();

 private:
  static constexpr std::size_t kChunk = 8192;  // work between two looks at the clock
  static constexpr std::size_t kGrain = 256;

  // Of grids of rays finer than the first, in cells a side, not all rays are kept, but those over
  // the second.
  static constexpr int kWholeGrid = 12, kKeptGrid = 8;

  // Rays over a hemisphere, cells a side: the least, and the most until it is known who gathers.
  // The sky may show through openings that fewer would miss; but first it must be known how much
  // light there is, for the sake of rays that are not kept.
  bool sky_shows() const { return rays_.scene().sky && mean_irradiance() > 0; }
  int coarsest_grid() const { return sky_shows() ? 24 : 8; }
  int trial_grid() const { return sky_shows() ? 32 : kWholeGrid; }

  // Of a linear function's error squared over a triangle, as a mean: 8/45 (Σ e² + Σ e e') for the
  // errors e in the middles of its sides, quadratic between them; at most this times Σ e².
  static constexpr double kMeanSquare = 16.0 / 45;

  /// What interpolation may be off by in the middle of an edge: what is likely, and the variance of
  /// that.
  struct EdgeError {
    double likely = 0;
    double variance = 0;
  };

  /// The mean over all surfaces of the square of what interpolation is off by, for the errors
  /// error(edge), relative to what they are held against, in the middles of edges.
  template <typename Error>
  double mean_square(Error&& error) const {
    const std::span<const Triangle> triangles = mesh_.triangles();
    std::vector<double> squares(triangles.size());
    parallel_for(triangles.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!triangles[i].alive) continue;
        const auto between = [&](VertexId v, VertexId w) {
          return error(v < w ? Edge{v, w, 0} : Edge{w, v, 0});
        };
        const auto& [a, b, c] = triangles[i].vertices;
        const auto [e, u] = between(a, b);
        const auto [f, v] = between(b, c);
        const auto [g, w] = between(c, a);
        const double sum = e * e + f * f + g * g + e * f + f * g + g * e + u + v + w;
        squares[i] = kMeanSquare / 2 * sum * weight(triangles[i]);
      }
    });
    return std::accumulate(squares.begin(), squares.end(), 0.0) / area();
  }

  // The procedure
  void first_solution();
  double goal() const;
  bool on_the_way() const;
  bool next_level();
  bool full() const;
  bool keep_going();
  double unshot_part() const;
  double emitted_flux() const;
  void estimate();
  void finish();

  // What surrounds a vertex
  void look_around();
  const Surroundings* around(VertexId v) const;
  double usual_irradiance(VertexId v) const;
  double extent(VertexId v) const;
  double room_importance(VertexId v) const { return square(diagonal_ / extent(v)); }
  double importance(VertexId v) const;
  double weight(const Triangle& triangle) const;

  // E_d
  struct Middle {  // of an edge
    std::optional<SurfacePoint> point;
    Rgb direct;
    double deviation = 0;
  };
  void refine_direct();
  void light_directly(std::span<const VertexId> vertices);
  void light_newborn();
  void look_closer();
  std::vector<Middle> middles_of(std::span<const Edge> edges);
  void light_middles(std::span<const Edge> edges, std::span<const std::uint32_t> chosen,
                     std::span<Middle> middles);
  double error_at(const Edge& edge, const Middle& middle) const;
  static MiddleLight packed(const Middle& middle, double error);
  bool too_open(double deviation, double scale) const;
  void sample(std::span<const Edge> edges);
  void look_at(std::span<const Edge> edges);
  double direct_bend(const Edge& edge) const;
  bool hairline(const Edge& edge) const;
  double direct_mean_square(std::span<const Edge> edges, std::span<const double> errors);
  void split_worst(std::span<const Edge> edges, std::span<const double> errors, double total,
                   double target);
  void split_all(std::span<const Edge> edges);
  std::vector<Edge> longer_sides(std::span<const Edge> edges) const;
  void split(std::span<const Edge> edges, std::span<const Middle> middles);

  // What lies hidden close under another sheet
  bool covered(const SurfacePoint& point, double far) const;
  bool hidden(const SurfacePoint& middle, const Edge& edge) const;
  bool touched_beside(const SurfacePoint& point, const SurfacePoint& other) const;
  std::vector<MeshPlace> seen_beside_hidden();
  void give_places(const Coarsening& subsets);
  void light_hidden();

  // E_i
  void gather_all(int finest);
  void trace(std::span<const VertexId> vertices, std::span<const int> grids);
  std::vector<double> doubts();
  std::vector<double> areas_of_influence(std::vector<double> around);
  std::vector<int> wanted_grids();
  void trace_as_wanted(std::span<const VertexId> vertices, std::span<const int> wanted, int finest);
  struct RowRequest {
    Receiver receiver;
    int grid;  // cells a side
    std::uint64_t id;
  };
  struct TracedRow {
    Row<Link> links;          // those to keep
    int grid = 0;             // of all rays, cells a side
    std::size_t rays = 0;     // that were traced
    Gathered beyond;          // lx: what all brought more than those to keep; σ of what all did
    double escaped = 0;       // part of the rays that no light comes back from
    std::vector<Site> fresh;  // of the links to kFresh, in their order
  };
  void trace_rows(std::span<const RowRequest> requests,
                  const std::function<void(std::size_t, TracedRow)>& take);
  TracedRow traced(const RowRequest& request) const;
  void list_fresh_sites(TracedRow& row);
  void give_links(VertexId v, TracedRow row);
  void drop_unused_sites();
  void light_sites();
  void glimpse();
  void look_up_anew();
  std::vector<VertexId> outdated_vertices() const;
  Gathered gather(const Row<Link>& row) const;
  Gathered gather(const TracedRow& row) const;
  Rgb gathered_by(const VertexLight& light) const;
  void evaluate(std::span<const VertexId> vertices);
  void interpolate_indirect(VertexId v);
  void foresee_bends(VertexId first);
  const std::vector<VertexId>& order();
  void transfer(bool rough = false);
  void share_out();
  void balance_indirect();
  void settle_energy(std::span<const Rgb> old);
  void add_ambient(std::span<const Rgb> old);
  void find_excess();

  // Refinement for E_i
  void refine_indirect();
  std::vector<VertexId> doubtful_vertices(double budget) const;
  std::vector<Edge> suspect_edges(std::span<const Edge> edges, double budget) const;
  void gather_at_doubtful(std::span<const VertexId> doubtful);
  void split_suspects(std::span<const Edge> suspect, double allowed);
  struct Finding {    // of a place that was looked at
    double foreseen;  // by the rule, as it is scaled, squared, m² · lx²
    double found;  // the square of the error that was found, less the noise that it has, m² · lx²
    double noise;  // of `found`, m² · lx²
  };
  static void learn(double& rule_scale, std::vector<Finding> findings);
  void learn_lean(double found, double foreseen);
  double difference(VertexId v, VertexId w) const;
  double usual_bend(VertexId v, VertexId w) const;
  double area_around(VertexId v) const;
  std::vector<double> areas_around() const;
  double rule_bend(VertexId v) const;
  double bend_beside(VertexId v) const;
  double surprise(VertexId v) const;
  double most_bend(VertexId v) const;
  double leniency(VertexId v, double area) const;
  bool stands_out(const Edge& edge, double e) const;
  EdgeError indirect_error(const Edge& e) const;
  double likely_indirect_error(const Edge& e) const;
  double indirect_mean_square() const;

  Rgb irradiance(VertexId v) const { return state_.light[v].direct + state_.light[v].indirect; }
  void sum_up(VertexId v);
  double area() const { return state_.statistics.mesh_area; }
  double mean_irradiance() const { return state_.statistics.mean_irradiance; }
  double variance_of(VertexId v) const;
  double mean_variance(const Triangle& triangle) const;

  static double square(double x) { return x * x; }
  static constexpr std::uint64_t square_of(int n) {
    return static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(n);
  }

  /// What errors at a vertex are held against, lx: the usual E, or E there where that is more. Else
  /// the inside of a small lamp would be all that counts.
  double scale(VertexId v) const { return std::max(usual_irradiance(v), luminance(irradiance(v))); }
  double scale(const Edge& edge) const { return (scale(edge.a) + scale(edge.b)) / 2; }

  /// What an error in the middle of an edge adds to the square of the error over all surfaces, m².
  double cost(const Edge& edge, double e) const {
    return kMeanSquare * square(e / scale(edge)) * edge.area *
           ((importance(edge.a) + importance(edge.b)) / 2);
  }

  /// Of interpolation in the middle of an edge as far as it was looked at, lx, positive where it is
  /// too bright.
  double direct_error(const Edge& e) const {
    const auto at = state_.middles.find(e.key());
    return at == state_.middles.end() ? 0 : at->second.error;
  }

  template <typename Error>
  static std::vector<double> of_edges(std::span<const Edge> edges, const Error& error) {
    std::vector<double> errors(edges.size());
    parallel_for(edges.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) errors[i] = error(edges[i]);
    });
    return errors;
  }

  /// The mean of the errors `e` of edges around each vertex, by area, so that the sum over the
  /// whole mesh is right.
  template <typename Error>
  std::vector<double> around_vertices(std::span<const Edge> edges, Error&& error) const {
    const std::vector<double> errors = of_edges(edges, error);
    std::vector<double> sum(state_.light.size()), area(state_.light.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Edge& e = edges[i];
      for (const VertexId v : {e.a, e.b}) sum[v] += errors[i] * e.area, area[v] += e.area;
    }
    for (std::size_t v = 0; v < sum.size(); ++v) {
      if (area[v] > 0) sum[v] /= area[v];
    }
    return sum;
  }

  GatheringState& state_;
  Triangulation& mesh_;
  const RayCaster& rays_;
  const Options& options_;
  const GatheringCallbacks& callbacks_;
  const Stopwatch stopwatch_;
  const DirectLight lights_;
  const double diagonal_;                       // of the scene, m
  std::optional<HemisphereGather> hemisphere_;  // over the mesh as it was at look_up_anew()
  std::vector<SiteLight> site_light_;           // by site, as of light_sites()
  std::vector<VertexId> order_;          // vertices, each after those it is interpolated from
  std::vector<double> indirect_excess_;  // by vertex, lx: of the errors of E_i
  /// A third of the triangles at a vertex: their area, m², and what they emit, lm; of that, what
  /// reaches others by hemisphere rays.
  struct Share {
    double area = 0, seen = 0;  // m²: of triangles, and as far as light reaches them
    Rgb emitted, emitted_to_rays;
  };
  std::vector<Share> shares_;  // by vertex, as of share_out()
  bool closed_ = true;         // no light leaves the scene, as of the last transfer()
  bool stopped_ = false;
};

}  // namespace isolux
