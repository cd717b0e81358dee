#pragma once

#include <span>

#include "isolux/image/surface_sampler.h"
#include "isolux/radiosity/direct_light.h"

namespace isolux {

/// Puts the light that comes straight from the lights, gathered at every sample of a picture, in
/// place of what the mesh interpolates of it: shadows as sharp as they are.
class DirectFinish {
 public:
  /// Gathers the direct light of all vertices, to know what of theirs is direct. `solution` is one
  /// by gathering, and outlives this; so does `rays`, of its scene.
  DirectFinish(const Solution& solution, const RayCaster& rays);

  /// Changes the samples of one pixel. May be asked from many threads at once.
  void apply(std::span<SurfaceSample> samples) const;

 private:
  DirectLight lights_;
  std::vector<char> hidden_;  // by vertex
  std::vector<Rgb> direct_;   // E_d by vertex, lx
};

}  // namespace isolux
