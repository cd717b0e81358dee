#pragma once

#include <embree3/rtcore.h>

#include <memory>

namespace isolux {

/// The one Embree device of the process. It is given no number of threads: that would limit every
/// parallel loop of the process. Throws std::runtime_error where Embree can't start.
std::shared_ptr<RTCDeviceTy> embree_device();

}  // namespace isolux
