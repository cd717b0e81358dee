#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/radiosity/visibility.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

struct LightLattice;

/// The light that arrives straight from the separate lights of a scene and from its sources.
///
/// A light seen whole counts by the closed form (form_factor()). Elsewhere rays to the points of a
/// lattice over the light say what of it is seen; on lattice lines between a seen and a hidden
/// point the shadow's edge is searched, and what it cuts off is left out.
class DirectLight {
 public:
  /// `rays` must outlive it.
  explicit DirectLight(const RayCaster& rays);

  /// separate_lights() of the scene.
  std::span<const std::uint8_t> separate() const { return separate_; }

  /// The direct irradiance (lx) at each receiver, and one standard deviation of its luminance (lx).
  /// Groups of those that stand close together and face alike share what is found out. Shadows'
  /// edges are searched as closely as a solve to `tolerance` needs. Runs in parallel; a value
  /// depends on the list, not on the number of threads. `keep_going`, if any, is asked now and
  /// then; once it says no, the rest is left as it is.
  void irradiance(std::span<const Receiver> receivers, std::span<Rgb> irradiance,
                  std::span<double> error, double tolerance = 0,
                  const std::function<bool()>& keep_going = {}) const;

 private:
  const RayCaster& rays_;
  std::vector<std::uint8_t> separate_;
  std::vector<std::shared_ptr<const LightLattice>> lights_;
};

}  // namespace isolux
