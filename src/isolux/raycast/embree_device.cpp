#include "isolux/raycast/embree_device.h"

#include <stdexcept>

namespace isolux {

std::shared_ptr<RTCDeviceTy> embree_device() {
  static const std::shared_ptr<RTCDeviceTy> device(rtcNewDevice(nullptr), [](RTCDevice d) {
    if (d) rtcReleaseDevice(d);
  });
  if (!device) throw std::runtime_error("Embree can't start on this machine");
  return device;
}

}  // namespace isolux
