#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "isolux/discretization/triangulation.h"
#include "isolux/radiosity/form_factor.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// A triangle that sends out light, seen from its front.
struct Emitter {
  std::array<Vec3, 3> corners;
  Vec3 normal;
  /// How far the true surface stands out over the triangle: at barycentric (b₀, b₁, b₂) by
  /// b₀b₁ bulge[0] + b₁b₂ bulge[1] + b₂b₀ bulge[2] (m). Visibility is asked for there, so that a
  /// convex surface does not hide its own chords.
  std::array<double, 3> bulge{};
  bool light = false;  ///< emits by itself: its shadows are sharp, so small occluders are sought
};

/// The triangle as an emitter, its bulge from the normals of its vertices.
Emitter emitter_of(const Triangulation& mesh, TriangleId triangle);

/// The form factor from each receiver to the visible part of the emitter, into `factors`.
///
/// Visibility is asked of the true geometry by rays to the emitter's corners (§3.3); of a light, to
/// the corners of the 16 pieces that it is cut into. Where they disagree, the piece is cut in four,
/// at most `subdivisions` times; in a piece still half hidden then, the edge of the shadow is found
/// on its sides to within 1/128 of their length, and the visible part is the polygon that it cuts
/// off. Returns the number of rays.
std::uint64_t visible_form_factors(const RayCaster& rays, const Emitter& emitter,
                                   std::span<const Receiver> receivers, int subdivisions,
                                   std::span<double> factors);

}  // namespace isolux
