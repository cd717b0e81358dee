#pragma once

#include "isolux/discretization/triangulation.h"

namespace isolux {

/// What a triangle has received or emits and not yet sent on, lm/m²: E + mean(V.B) − already shot.
/// (Assigning R.ΔB as printed in §3.2.1 would lose the light of all shots but the last.)
Rgb unshot_radiosity(const Triangulation& mesh, const Triangle& triangle);

/// Light in the whole mesh.
struct Energy {
  double emitted_flux = 0;  ///< of the lights, lm
  double unshot_flux = 0;   ///< waiting in all triangles, both signs counted positive, lm
  double area = 0;          ///< of the triangles, m²
  /// Cohen's (1988) estimate of the radiosity that the unshot light will add on average if it
  /// spreads evenly: the mean unshot radiosity / (1 − mean ρ), lm/m².
  double ambient_exitance = 0;
};
Energy energy_of(const Triangulation& mesh);

}  // namespace isolux
