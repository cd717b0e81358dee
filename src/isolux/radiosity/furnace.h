#pragma once

#include "isolux/discretization/triangulation.h"
#include "isolux/radiosity/statistics.h"
#include "isolux/scene/scene.h"

namespace isolux {

// A manufactured solution: a closed scene in which every surface i reflects ρ_i and emits
// B₀ (1 − ρ_i) has the exitance B₀ everywhere, whatever its geometry, since B₀ = B₀ (1 − ρ_i) +
// ρ_i B₀. What a solution differs from that is the solver's own: chance, leaks, light that is lost.

/// The furnace that has the geometry of `scene`: each object gets a reflectance of its own, 0.2 to
/// 0.8, and emits to match; sources and the sky are left out. Objects keep their indices. Open
/// surfaces get their back as another object, whatever sides they had, and a box around all closes
/// the scene. `exitance`: B₀, lm/m². Throws InputError where the scene has no objects.
Scene furnace_scene(const Scene& scene, double exitance);

/// How far the solution of a furnace is off. Vertices without triangles don't count.
struct FurnaceReport {
  double rms = 0;              ///< root mean square of B / B₀ − 1, over the area
  double worst = 0;            ///< B / B₀ − 1 at the vertex where it is furthest from 0
  Vec3 place;                  ///< of that vertex, m
  std::uint32_t object = 0;    ///< whose it is
  double emitted_flux = 0;     ///< lm: by what has triangles, as all below
  double absorbed_flux = 0;    ///< lm
  double escaped_flux = 0;     ///< lm: left the box, or fell on what is black
  double unshot_flux = 0;      ///< lm
  double unaccounted() const;  ///< emitted − absorbed − escaped − unshot, lm
};

/// Judges a solution of furnace_scene(…, exitance).
FurnaceReport judge_furnace(const Scene& furnace, const Triangulation& mesh,
                            const Statistics& statistics, double exitance);

}  // namespace isolux
