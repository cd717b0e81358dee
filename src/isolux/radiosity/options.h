#pragma once

#include <cstdint>
#include <string>

#include "isolux/discretization/triangulation.h"

namespace isolux {

/// How the light is found.
enum class Method {
  gathering,  ///< surfaces are covered first; each vertex gathers, until a tolerance is met
  shooting,   ///< progressive radiosity as in the paper: triangle after triangle sends its light
};

/// Which triangle shoots next.
enum class Selection {
  radiosity,  ///< the brightest: the largest unshot radiosity (the paper's)
  power,      ///< the most unshot power, radiosity × area (Cohen 1988)
};

/// How rays cover the hemisphere above an emitter (§4).
enum class Distribution {
  uniform,  ///< equal solid angles (§4.1)
  malley,   ///< jittered on the disk, lifted to the hemisphere: cosine density (§4.2)
};

/// Everything that steers a solve. Those of the paper have the values that reproduce its Table 1
/// (docs/reproduction.md); gathering needs none of them.
struct Options {
  Method method = Method::gathering;
  double tolerance = 0.01;  ///< gathering: root mean square of the error of illuminance over all
                            ///< surfaces, relative to its mean or, where that is more, itself
  std::uint64_t max_triangles = 0;  ///< gathering: refine no further than this many, 0: no bound

  Rules rules;                   ///< δ, Δ, α_n
  double contrast = 2.0;         ///< α_s: a triangle is split where its ΔE's differ by more
                                 ///< than α_s × their mean (rule 5)
  int iterations = 800;          ///< shots
  double stop_at_unshot = 1e-3;  ///< stop where this fraction of the emitted power is unshot
  int grid = 28;                 ///< rays per vertex: a grid × grid of jittered cells
  int least_rays = 0;            ///< extra uniform rays per vertex, for small objects (§4.2)
  Distribution distribution = Distribution::malley;
  int eye_grid = 32;                ///< rays of the eye pass: eye_grid², 0 for none
  double pairing_tolerance = 0.02;  ///< relative to the distance along the ray
  int subdivisions = 1;             ///< of an emitter half hidden from a vertex
  Selection selection = Selection::radiosity;
  bool refine = true;  ///< off: transfer energy over the mesh as it stands
  std::string camera;  ///< whose eye the eye pass takes; empty: the first
  std::uint64_t seed = 1;
};

}  // namespace isolux
