#pragma once

#include "isolux/discretization/cover.h"

namespace isolux {

/// A cover of the caster's scene with points at most `spacing` (m) apart.
inline Triangulation covered(const RayCaster& rays, double spacing) {
  Triangulation mesh({2.2 * spacing, 1e-9, 0.77}, rays.scene().bounds());
  cover(mesh, rays, {spacing, 1});
  return mesh;
}

}  // namespace isolux
