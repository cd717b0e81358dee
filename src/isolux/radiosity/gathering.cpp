#include "isolux/radiosity/gathering.h"

#include <algorithm>
#include <cmath>

#include "isolux/core/error.h"
#include "isolux/discretization/cover.h"
#include "isolux/radiosity/energy.h"
#include "isolux/radiosity/gathering_procedure.h"
#include "isolux/radiosity/illumination.h"
#include "isolux/radiosity/source_light.h"

namespace isolux {
namespace {

// No solution is worked for that is rougher than this, where the errors told would be less sure and
// little time is saved. What only finds the way is this rough, each next one finer by up to this
// factor.
constexpr double kRoughest = 0.05;
constexpr double kFirstTolerance = 0.08;
constexpr double kLevelRatio = 8;

// Subsets of the cover's vertices, one to gather first, the others where that is not enough.
// The sky may show through small openings that few rays find.
constexpr int kSubsets = 4, kSubsetsUnderSky = 1;

// What a triangle sends is right in the mean for light that is quadratic along its sides; of the
// error that linear interpolation would make, this part may be left.
constexpr double kBiasLeft = 0.25;

}  // namespace

Gathering::Gathering(GatheringState& state, const RayCaster& rays, const Options& options,
                     const GatheringCallbacks& callbacks)
    : state_(state),
      mesh_(state.mesh),
      rays_(rays),
      options_(options),
      callbacks_(callbacks),
      lights_(rays),
      diagonal_(rays.scene().bounds().diagonal()) {}

void Gathering::run() {
  if (mesh_.vertices().empty()) first_solution();
  // No light gets to any surface: there is nothing to refine.
  const bool dark = !(mean_irradiance() > 0);
  if (dark && !stopped_) state_.statistics.converged = true;
  for (; !dark && keep_going(); ++state_.statistics.iterations) {
    refine_direct();
    gather_all(trial_grid());
    transfer();
    if (on_the_way()) {
      state_.indirect_mean_square = indirect_mean_square();
    } else {
      refine_indirect();
      gather_all(HemisphereGather::kFinestGrid);
      transfer();
    }
    look_around();
    estimate();
    if (stopped_ || !next_level()) break;
  }
  finish();
}

/// Covers all surfaces and lights them roughly.
void Gathering::first_solution() {
  CoverOptions cover_options;
  cover_options.spacing = mesh_.rules().max_edge / 2;
  cover_options.seed = options_.seed;
  cover_options.keep_going = [this] { return keep_going(); };
  cover(mesh_, rays_, cover_options);
  state_.level = goal() < kRoughest ? kFirstTolerance : kRoughest;
  light_newborn();
  give_places(coarsen(mesh_, rays_.scene().sky ? kSubsetsUnderSky : kSubsets));
  light_hidden();
  state_.statistics.emitted_flux = emitted_flux();
  gather_all(trial_grid());
  transfer();
  look_around();
  estimate();
}

/// The tolerance that a solve works for, until its estimate is within what was asked for.
double Gathering::goal() const { return std::min(options_.tolerance, kRoughest); }

/// Whether a stricter level follows in any case: then this one only finds the way.
bool Gathering::on_the_way() const { return state_.level > goal() && !full(); }

/// Goes on to a stricter level; false where the goal is reached, or out of reach.
bool Gathering::next_level() {
  constexpr int kMostTries = 6;
  constexpr double kTighter = 0.7, kBarely = 0.95;
  if (on_the_way()) {
    state_.level = std::max(goal(), state_.level / kLevelRatio);
    look_closer();
    return true;
  }
  state_.statistics.converged = state_.statistics.error <= options_.tolerance;
  if (state_.statistics.converged || full()) return false;
  state_.level *=
      std::clamp(kBarely * options_.tolerance / state_.statistics.error, kTighter, kBarely);
  return ++state_.tries < kMostTries;
}

bool Gathering::full() const {
  return options_.max_triangles > 0 && mesh_.triangle_count() >= options_.max_triangles;
}

/// Asks the caller whether to go on; once it is refused, it stays refused.
bool Gathering::keep_going() {
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

double Gathering::unshot_part() const {
  return state_.statistics.emitted_flux > 0
             ? state_.statistics.unshot_flux / state_.statistics.emitted_flux
             : 1;
}

/// Of all objects, lm: of those whose area is not known, as the cover has them. Of sources and the
/// sky, what arrives.
double Gathering::emitted_flux() const {
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
  for (const Source& source : rays_.scene().sources) flux += arriving_flux(rays_, source);
  if (rays_.scene().sky) flux += arriving_flux(rays_, *rays_.scene().sky);
  return flux;
}

double Gathering::variance_of(VertexId v) const {
  const VertexLight& light = state_.light[v];
  return square(light.direct_deviation) + square(light.indirect_deviation);
}

/// Of what is interpolated over a triangle, on average and relative to what errors are held
/// against: (Σ σ² + Σ cov) / 6. Chances of E_d, and of E_i at vertices that gather by themselves,
/// are independent; of E_i at others, and at hidden ones, they are taken to be as alike as can be.
double Gathering::mean_variance(const Triangle& triangle) const {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const VertexId v = triangle.vertices[k], w = triangle.vertices[(k + 1) % 3];
    sum += variance_of(v) / square(scale(v));
    if (mesh_.vertex(v).hidden || mesh_.vertex(w).hidden) {
      sum += std::sqrt(variance_of(v) * variance_of(w)) / (scale(v) * scale(w));
    } else if (!state_.light[v].gathers || !state_.light[w].gathers) {
      sum += state_.light[v].indirect_deviation / scale(v) * state_.light[w].indirect_deviation /
             scale(w);
    }
  }
  return sum / 6;
}

/// The errors of all vertices, and of the whole.
void Gathering::estimate() {
  double variance = 0, reflectance = 0, escaped = 0, total = 0;
  for (const Triangle& triangle : mesh_.triangles()) {
    if (!triangle.alive) continue;
    variance += mean_variance(triangle) * weight(triangle);
    for (VertexId v : triangle.vertices) {
      const double part = triangle.area / 3;
      reflectance += luminance(mesh_.vertex(v).reflectance) * part;
      escaped += state_.light[v].escaped * part;
      total += part;
    }
  }
  if (!(total > 0 && mean_irradiance() > 0)) return;
  // What the emitters have too much or too little of all gather alike, once for every reflection.
  const double again = reflectance / total * (1 - escaped / total);
  const double unshot = state_.statistics.unshot_flux / total;
  state_.statistics.emitter_error =
      (kBiasLeft * again * std::abs(state_.bias) + unshot) / (1 - again);
  const double interpolation = std::sqrt(state_.direct_mean_square + state_.indirect_mean_square);
  const double deviation = std::sqrt(variance / total);
  state_.statistics.discretization_error = interpolation;
  state_.statistics.narrow_error = std::sqrt(state_.narrow_mean_square);
  state_.statistics.sampling_error = deviation;
  state_.statistics.error =
      std::hypot(interpolation, deviation) + state_.statistics.emitter_error / mean_irradiance();
}

/// What goes with the solution.
void Gathering::finish() {
  // Told to stop before the first sweep: all but the direct light is unshot.
  if (!(area() > 0)) {
    share_out();
    settle_energy(std::vector<Rgb>(state_.sent.size()));
  }
  const std::vector<double> interpolation =
      around_vertices(living_edges(mesh_), [&](const Edge& e) {
        const auto [likely, variance] = indirect_error(e);
        return direct_bend(e) + std::sqrt(square(likely) + variance);
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
  std::size_t rays = 0;
  state_.statistics.gatherers = 0;
  for (const VertexLight& light : state_.light) {
    if (!light.gathers) continue;
    ++state_.statistics.gatherers;
    rays += light.rays;
  }
  state_.statistics.gather_rays =
      static_cast<int>(rays / std::max<std::size_t>(state_.statistics.gatherers, 1));
  state_.statistics.triangles = mesh_.triangle_count();
  state_.statistics.vertices = mesh_.vertices().size();
  state_.statistics.cpu_seconds = stopwatch_.cpu();
  state_.statistics.wall_seconds = stopwatch_.wall();
}

/// What a vertex sends follows from what it has.
void Gathering::sum_up(VertexId v) {
  const Rgb e = irradiance(v);
  const double l = luminance(e);
  state_.sent[v] = l > 0 ? e * std::clamp(1 - state_.light[v].excess / l, 0.3, 1.7) : e;
}

Rules gathering_rules(const Scene& scene) {
  constexpr double kLongestEdges = 8.5;  // across the scene
  constexpr double kSmooth = 0.77;       // rad: a little less than half a right angle
  const double size = scene.bounds().diagonal();
  Rules rules;
  rules.max_edge = size / kLongestEdges;
  rules.min_area = 1e-14 * size * size;
  rules.normal_tolerance = kSmooth;
  return rules;
}

void gather_radiosity(GatheringState& state, const RayCaster& rays, const Options& options,
                      const GatheringCallbacks& callbacks) {
  if (!rays.scene().has_light()) {
    throw InputError(
        "the scene has no light: give an object an 'emission', or 'lights', or a 'sky'");
  }
  Gathering(state, rays, options, callbacks).run();
}

}  // namespace isolux
