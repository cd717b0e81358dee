#pragma once

#include <cstdint>

#include "isolux/image/picture.h"
#include "isolux/image/supersample.h"
#include "isolux/solution/solution.h"

namespace isolux {

/// How many of a picture's samples found their light in which way (SampleKind).
struct SampleCounts {
  std::uint64_t interpolated = 0;
  std::uint64_t extrapolated = 0;
  std::uint64_t dark = 0;
  std::uint64_t background = 0;
};

struct Rendering {
  Picture picture;  ///< luminance, cd/m²: of a diffuse surface, its exitance / π
  SampleCounts samples;
};

/// Resampling (§3.3.1): every sample meets the true surface, and takes its light from the triangle
/// paired with it, or where there is none from the vertices around it; with RenderOptions::direct,
/// straight from the lights (DirectFinish). Where there is no surface the picture is black. Throws
/// InputError as supersample() does, and where direct light is asked for of a solution by shooting.
Rendering render(const Solution& solution, const Camera& camera, const RenderOptions& options = {});

}  // namespace isolux
