#pragma once

#include <embree3/rtcore.h>

#include <memory>

#include "isolux/geometry/shape.h"

namespace isolux {

/// The one Embree device of the process. It is given no number of threads: that would limit every
/// parallel loop of the process. Throws std::runtime_error where Embree can't start.
std::shared_ptr<RTCDeviceTy> embree_device();

/// The ray in Embree's single precision, reaching a little farther than t_max.
RTCRayHit embree_ray(const Ray& ray, double t_max);

}  // namespace isolux
