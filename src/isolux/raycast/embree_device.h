#pragma once

#include <embree3/rtcore.h>

#include <memory>

namespace isolux {

/// The one Embree device of the process; trees are built on the calling thread, so that they come
/// out the same whatever the number of threads. Throws std::runtime_error where Embree can't start.
std::shared_ptr<RTCDeviceTy> embree_device();

}  // namespace isolux
