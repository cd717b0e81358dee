#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

// The surfaces that scene formats with no solids have, in metres. Round ones face outward unless
// `inward`.

struct SphereSurface {
  Vec3 center;
  double radius;
  bool inward;
};

/// The open side of a cone between two points; a cylinder where the radii are equal.
struct ConeSurface {
  Vec3 from, to;
  double from_radius, to_radius;
  bool inward;
};

/// A flat ring, or disk, that faces along the unit vector `normal`.
struct RingSurface {
  Vec3 center, normal;
  double inner_radius, outer_radius;
};

struct TorusSurface {
  Vec3 center, axis;
  double major_radius, minor_radius;
  bool inward;
};

/// Flat faces, each a list of places in `points`, counter-clockwise as seen from the front.
struct FacesSurface {
  std::vector<Vec3> points;
  std::vector<std::vector<std::uint32_t>> faces;
};

using SimpleSurface =
    std::variant<SphereSurface, ConeSurface, RingSurface, TorusSurface, FacesSurface>;

/// What such a format has.
struct SurfaceFormat {
  std::string name;
  bool torus = false;
  std::size_t most_corners = 0;  ///< of a face
  bool infinity = false;         ///< light that comes from there: the sky, directional sources
};

/// An object that triangles stand for, and how well.
struct Triangulated {
  std::string object;
  double deviation;  ///< m, as of an Approximation
  double lost;       ///< likewise
};

/// The surfaces that the object is made of. Where the format lacks one, or a map stretches what is
/// round, triangles stand for the object, and it is added to `triangulated`. Throws InputError that
/// names the object where that would be more than 10⁶.
std::vector<SimpleSurface> simple_surfaces(const Object& object, const SurfaceFormat& format,
                                           std::vector<Triangulated>& triangulated);

/// What writers of such formats note: cameras, lights without a surface and the sky, as far as they
/// are left out, and objects that triangles stand for.
std::vector<std::string> notes_of(const Scene& scene, const SurfaceFormat& format,
                                  const std::vector<Triangulated>& triangulated);

}  // namespace isolux
