#pragma once

#include <cstdint>
#include <vector>

#include "isolux/radiosity/visibility.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

/// What path tracing found at a point.
struct TracedIrradiance {
  double irradiance = 0;      ///< luminance, lx
  double standard_error = 0;  ///< lx
  std::uint64_t paths = 0;
};

/// The rival: path tracing with next-event estimation (Kajiya 1986) on the same ray caster. It
/// needs no mesh; every point costs the same, however many there are. Each bounce looks for one
/// point of the lights and for every source; a path that leaves the scene brings the sky's light.
///
/// Paths start in batches of 4 × 4, whose first directions and first points on the lights are
/// stratified; the batch goes on bounce by bounce, so that its shadow rays are traced together.
/// After the second bounce, Russian roulette by the reflectance. The standard error is that of the
/// means of batches, which are independent.
class PathTracer {
 public:
  /// `rays` must outlive it. All lights are taken as the triangles they can be cut into, which are
  /// chosen in proportion to their flux; so they should be flat.
  explicit PathTracer(const RayCaster& rays);

  /// Paths until the standard error is at most `relative` of the irradiance, or at most `absolute`
  /// (lx); at least 32 batches, so that the error can be trusted, at most `most_paths`.
  TracedIrradiance irradiance(const Receiver& receiver, double relative, double absolute,
                              std::uint64_t most_paths, std::uint64_t seed, std::uint64_t id) const;

 private:
  struct LightTriangle {
    Vec3 corner, u, v, normal;
    double upto;  ///< the part of all flux that comes from here and from those before
  };
  struct Path {
    Receiver at;
    double throughput;  ///< 0 where it has ended
  };
  struct Batch;
  Vec3 light_point(double choice, double a, double b, const LightTriangle*& triangle) const;
  double batch_mean(const Receiver& receiver, Batch& batch) const;
  void look_for_lights(Batch& batch) const;
  void look_for_sources(Batch& batch) const;
  void next_event(Batch& batch) const;

  const RayCaster& rays_;
  std::vector<LightTriangle> lights_;  // none where only sources and the sky give light
  double flux_ = 0;                    // of all lights, lm
  std::vector<double> reflectance_;    // by object, luminance
};

}  // namespace isolux
