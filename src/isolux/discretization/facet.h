#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "isolux/discretization/interpolation.h"

namespace isolux {

/// A vector in single precision, which is enough for a place in a triangle: coordinates count from
/// the middle of the mesh.
struct Vec3f {
  float x, y, z;
};

inline Vec3f narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
inline Vec3f operator-(const Vec3f& a, const Vec3f& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline float dot(const Vec3f& a, const Vec3f& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// All of a triangle, in one line of the cache: with d = p − corner, the weights of the second and
/// third vertex are along[0]·d and along[1]·d, and the height over it is up·d, in parts of how far
/// the surface may stand off it.
struct alignas(64) Facet {
  // How far outside its sides a triangle still counts, in parts of its height: over a convex edge
  // of the mesh the feet of two neighbours' perpendiculars leave a narrow wedge open.
  static constexpr float kOutside = 0.05f;
  // What the whole reach of a triangle counts in the same measure.
  static constexpr float kHeight = 0.1f * kOutside;

  Vec3f corner;
  std::array<Vec3f, 2> along;
  Vec3f up;
  std::uint32_t object;
  std::array<VertexId, 3> vertices;
};
static_assert(sizeof(Facet) == 64);

/// The facet of a living triangle of the mesh, whose middle it counts from.
Facet facet_of(const Triangulation& mesh, TriangleId id, const Vec3& middle);

/// All places from which the triangle may be found, seen from the middle of the mesh: the triangle
/// scaled about its own middle so that weights go down to −kOutside, and its reach.
Bounds facet_box(const Triangulation& mesh, TriangleId id, const Vec3& middle);

/// A facet over a point.
struct FacetOver {
  float score;  // the less, the nearer
  std::uint32_t facet;
  std::array<float, 3> weights;
  bool inside;  // all sides
  auto operator<=>(const FacetOver& other) const {
    return std::pair(score, facet) <=> std::pair(other.score, other.facet);
  }
};

/// Facet number `index`, if it lies over the point `p` and faces as the unit vector `n` does, to
/// within the largest angle between a triangle and the surface that it stands for, 60°.
inline std::optional<FacetOver> over(const Facet& facet, std::uint32_t index, const Vec3f& p,
                                     const Vec3f& n) {
  const Vec3f d = p - facet.corner;
  const float w1 = dot(facet.along[0], d), w2 = dot(facet.along[1], d);
  constexpr float kFacing = 0.5f;  // cos 60°
  const float outside = std::max({-w1, -w2, w1 + w2 - 1});
  if (outside > Facet::kOutside) return std::nullopt;
  const float height = std::abs(dot(facet.up, d)), facing = dot(facet.up, n);
  if (height > 1) return std::nullopt;
  if (facing < 0 || facing * facing < kFacing * kFacing * dot(facet.up, facet.up)) {
    return std::nullopt;
  }
  return FacetOver{std::max(outside, 0.0f) + height * Facet::kHeight,
                   index,
                   {1 - w1 - w2, w1, w2},
                   outside <= 0};
}

/// The place of these weights in the facet, of which those below zero count as zero.
inline MeshPlace place_in(const Facet& facet, const std::array<float, 3>& weights) {
  MeshPlace place{facet.vertices, {}};
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    sum += place.weights[k] = std::max(static_cast<double>(weights[k]), 0.0);
  }
  for (double& w : place.weights) w /= sum;
  return place;
}

}  // namespace isolux
