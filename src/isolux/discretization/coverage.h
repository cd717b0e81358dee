#pragma once

#include <cstdint>

#include "isolux/discretization/triangulation.h"

namespace isolux {

/// How much of a scene carries triangles.
struct Coverage {
  double area = 0;     ///< of the surface that light can reach, m²
  double covered = 0;  ///< the part of it over which a triangle lies, m²
};

/// Estimates the coverage by uniform random lines (Crofton); its standard error is about
/// 1 / √(hits) of the area. Deterministic.
Coverage coverage_of(const Triangulation& mesh, const RayCaster& rays, int lines,
                     std::uint64_t seed);

}  // namespace isolux
