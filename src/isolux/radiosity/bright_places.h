#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/core/vec3.h"
#include "isolux/discretization/triangulation.h"

namespace isolux {

/// The triangles of a mesh that are far brighter than the rest, such as a lamp's reflector: few
/// rays over a hemisphere find them, and these carry much of its light.
class BrightPlaces {
 public:
  /// Part of the space around a receiver that bright triangles may lie in.
  struct Cone {
    Vec3 direction;    ///< of its axis, unit length
    double chord;      ///< 2 sin(half its angle / 2)
    double radiosity;  ///< lm/m², of the brightest
  };

  BrightPlaces() = default;

  /// Of the living triangles, those whose radiosity (by triangle id, lm/m²) is over `least`.
  BrightPlaces(const Triangulation& mesh, std::span<const double> radiosity, double least);

  bool empty() const { return nodes_.empty(); }

  /// Cones that hold all bright triangles of a radiosity over `least` (lm/m²) whose front is turned
  /// to the receiver, each with a chord of at most `fine` where that is possible; what is nearer
  /// than its own size is left out. They replace what is in `cones`.
  void seen_from(const Vec3& point, const Vec3& normal, double least, double fine,
                 std::vector<Cone>& cones) const;

 private:
  /// Triangles, close together: all within a sphere and with normals within an angle of an axis.
  struct Node {
    Vec3 center, axis;
    double radius = 0;                      // m
    double cos_spread = 1, sin_spread = 0;  // of the angle
    double radiosity = 0;                   // lm/m², of the brightest
    std::uint32_t second = 0;  // of its halves, the first comes next; 0: a single triangle
  };
  struct Part;

  void add(std::span<Part> parts);

  std::vector<Node> nodes_;
};

}  // namespace isolux
