#pragma once

#include <optional>

#include "isolux/discretization/triangulation.h"
#include "isolux/radiosity/gathering.h"
#include "isolux/radiosity/options.h"
#include "isolux/radiosity/progress.h"
#include "isolux/radiosity/statistics.h"
#include "isolux/raycast/ray_caster.h"
#include "isolux/scene/scene.h"

namespace isolux {

struct Solved {
  Triangulation mesh;
  Statistics statistics;
};

/// The light of the scene on a triangulation grown from nothing: by gathering, or by the paper's
/// procedure Radiosity (§3.2.1).
/// Throws InputError where the scene has no light (by the paper's procedure: none that can be cut
/// into triangles, or one without a surface) or lies more than 1000 of its sizes from the origin,
/// options are out of range, or the camera does not exist. The same scene, options and seed give
/// the same bits on any number of threads.
Solved solve(const Scene& scene, const Options& options, const ProgressCallback& progress = {});

/// The same by gathering, in full: told between rounds, and perhaps on from a checkpoint.
Solved solve_by_gathering(const Scene& scene, const Options& options,
                          const GatheringCallbacks& callbacks,
                          std::optional<GatheringState> from = {});

/// Discretize light sources into triangles: the first line of the procedure. Their sides are about
/// `max_edge` (m) long at most; the diagonals of cells may be longer.
void discretize_lights(const Scene& scene, double max_edge, Triangulation& mesh);

/// The While loop of the procedure on a triangulation that holds the lights and perhaps more;
/// light already in it counts as shot where Triangle::shot says so.
Statistics transfer_energy(Triangulation& mesh, const RayCaster& rays, const Options& options,
                           const ProgressCallback& progress = {});

/// Throws InputError, naming the option, where one is out of range.
void check_options(const Options& options);

}  // namespace isolux
