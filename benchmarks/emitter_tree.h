#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isolux/discretization/triangulation.h"
#include "isolux/radiosity/form_factor.h"
#include "isolux/radiosity/visibility.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// The rival of HemisphereGather: the triangles of a mesh in a tree for each surface, opened for
/// each group of receivers where the error of one form factor for the whole node, times its
/// radiosity, asks for it (Hanrahan, Salzman & Aupperle 1991); visibility by rays to the true
/// geometry, none where nothing may stand between, more where the first ones disagree.
class EmitterTree {
 public:
  /// Both must outlive it. `separate`, by object: 1 where its own light is left out.
  EmitterTree(const RayCaster& rays, const Triangulation& mesh,
              std::span<const std::uint8_t> separate);

  /// What a receiver gathers from one node.
  struct Link {
    std::uint32_t node = 0;
    float factor = 0;  ///< form factor to what is seen of it
  };

  /// Luminance of the radiosity of every node, lm/m², under `irradiance` (lx) at the vertices.
  std::vector<double> radiosities(std::span<const Rgb> irradiance) const;

  /// Appends the links of each of at most 32 receivers, neighbours on one surface, to its row.
  /// `radiosity`: as radiosities() gives it; `epsilon`: what one link may be off by, lx. Returns
  /// the number of rays.
  std::uint64_t link(std::span<const Receiver> group, std::span<const double> radiosity,
                     double epsilon, std::uint64_t seed, std::span<std::vector<Link>> rows) const;

 private:
  class Opening;
  struct Node {
    Bounds bounds;
    Vec3 center, normal, vector_area;
    double area = 0, radius = 0;
    double low = 0;                      // least normal · p of its points
    double cone = 1;                     // least cosine between the normal and a triangle's
    std::uint32_t first = 0, count = 0;  // its emitters
    std::uint32_t child = 0;             // the first of two; 0: a leaf, one triangle

    bool flat() const { return cone > 1 - 1e-9; }
  };
  void fill(Node& node) const;
  void divide(std::uint32_t index);

  const RayCaster& rays_;
  const Triangulation& mesh_;
  std::vector<std::uint8_t> separate_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> roots_;
  std::vector<TriangleId> triangles_;  // node by node
  std::vector<Emitter> emitters_;      // of these triangles
  std::vector<double> area_up_to_;     // the sum of their areas
};

}  // namespace isolux
