#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "isolux/core/vec3.h"

namespace isolux {

/// A differential area that receives light.
struct Receiver {
  Vec3 point;   ///< on the true surface
  Vec3 normal;  ///< unit length
};

/// The form factor F_{dA_j–A_i} (eq. 4) from a differential area at `point` with unit `normal` to
/// a convex polygon, seen whole: the part of what leaves dA_j that arrives there, 0 … 1. The
/// polygon is clipped at the horizon of dA_j; which side of it faces the point does not matter.
///
/// §3.3 takes Γ_g for the cross product of unit vectors, whose length is sin γ; as its definition
/// says, it is scaled to the angle γ here (Hottel & Sarofim 1967). At most 4 corners.
double form_factor(const Vec3& point, const Vec3& normal, std::span<const Vec3> polygon);

/// The same from each of the receivers of these indices to one triangle, bit for bit, into
/// `factors` at these indices; faster, since most see a triangle small and above their horizon.
void form_factors(std::span<const Receiver> receivers, std::span<const std::uint32_t> indices,
                  const std::array<Vec3, 3>& triangle, std::span<double> factors);

/// The same to a sphere, seen whole from outside; 0 from inside. The horizon may cut it (Snyder
/// 1969, "Radiant energy transfer").
double sphere_form_factor(const Vec3& point, const Vec3& normal, const Vec3& center, double radius);

}  // namespace isolux
