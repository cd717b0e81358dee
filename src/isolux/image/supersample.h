#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "isolux/geometry/shape.h"
#include "isolux/image/picture.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// How a picture is sampled.
struct RenderOptions {
  int grid = 4;            ///< grid × grid jittered samples a pixel, 1 to 64
  std::uint64_t seed = 1;  ///< of the jitter
  bool direct = false;     ///< gather the lights' light anew at every sample
};

/// Called with the rays of all samples of a pixel, and the angle (rad) that a pixel's height spans
/// around them; returns the mean of what they see.
using Shade = std::function<Rgb(std::span<const Ray> rays, double pixel_angle)>;

/// Makes a picture, each pixel of which has its samples. `new_shade` is called once for
/// each row, perhaps from several threads, so that what it returns may keep scratch memory; the
/// picture depends on no thread. Throws InputError where the grid or the camera's size is out of
/// range (at most 32,768 pixels a side and 2^28 in all).
Picture supersample(const Camera& camera, const RenderOptions& options,
                    const std::function<Shade()>& new_shade);

}  // namespace isolux
