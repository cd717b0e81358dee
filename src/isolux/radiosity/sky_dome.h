#pragma once

#include <span>
#include <vector>

#include "isolux/discretization/interpolation.h"
#include "isolux/scene/sky.h"

namespace isolux {

/// A sky as a mesh of directions, so that rays that leave a scene land as those do that stay: its
/// nodes have a radiosity, and between them it is linear. Of the half above the horizon nodes have
/// equal shares, on a square grid; all below is one node.
class SkyDome {
 public:
  explicit SkyDome(const Sky& sky);

  static constexpr std::uint32_t node_count() { return kSide * kSide + 1; }

  /// π times the luminance, by node, lm/m².
  std::span<const Rgb> radiosity() const { return radiosity_; }

  /// Where a ray of that direction, of unit length, lands among the nodes.
  MeshPlace place(const Vec3& direction) const;

 private:
  static constexpr std::uint32_t kSide = 129;  // nodes a side
  Frame frame_;
  std::vector<Rgb> radiosity_;
};

}  // namespace isolux
