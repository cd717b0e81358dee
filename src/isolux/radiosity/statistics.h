#pragma once

#include <cstdint>

namespace isolux {

/// What a solve did. Fluxes are luminous (lm), the colour channels weighted to luminance.
struct Statistics {
  int iterations = 0;        ///< shots; of gathering: levels of tolerance
  bool converged = false;    ///< the tolerance was met, or (shooting) the unshot power fell below
                             ///< Options::stop_at_unshot
  bool interrupted = false;  ///< stopped by the caller before that
  std::uint64_t triangles = 0;  ///< alive, those of lights included
  std::uint64_t vertices = 0;
  std::uint64_t removed = 0;   ///< triangles that a ray proved wrong (§3.2.4)
  std::uint64_t extended = 0;  ///< vertices born by extension (§3.2.2)
  std::uint64_t split = 0;     ///< vertices born by splits (§3.2.5)
  std::uint64_t refinement_rays = 0;
  std::uint64_t shadow_rays = 0;  ///< of shooting; gathering does not count them
  double emitted_flux = 0;        ///< lm
  double unshot_flux = 0;         ///< lm
  double ambient_exitance = 0;    ///< lm/m²: Cohen's (1988) ambient term of what is unshot
  double mesh_area = 0;           ///< m²

  // Of gathering alone.
  int gather_rays = 0;          ///< over the hemisphere of a point that gathers, on average
  std::uint64_t gatherers = 0;  ///< vertices whose indirect light was gathered, not interpolated
  double absorbed_flux = 0;     ///< lm
  double escaped_flux = 0;      ///< lm: left the scene, or fell on black backs
  double imbalance = 0;         ///< lm: emitted − absorbed − escaped − unshot
  double mean_irradiance = 0;   ///< lx, over all surfaces
  /// Estimated root mean square over all surfaces, of each place's error relative to its irradiance
  /// or to mean_irradiance, whichever is more; under a sky as docs/gathering.md says.
  double error = 0;
  double discretization_error = 0;  ///< its part from interpolation
  double sampling_error = 0;        ///< its part from rays
  double narrow_error = 0;          ///< not in it: steps of light too narrow for the mesh
  double emitter_error = 0;  ///< lx: what interpolated emitters may add to any gathered value

  double cpu_seconds = 0;  ///< not part of the solution's file: it differs between runs
  double wall_seconds = 0;
};

}  // namespace isolux
