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

RTCRayHit embree_ray(const Ray& ray, double t_max) {
  RTCRayHit rayhit{};
  rayhit.ray.org_x = static_cast<float>(ray.origin.x);
  rayhit.ray.org_y = static_cast<float>(ray.origin.y);
  rayhit.ray.org_z = static_cast<float>(ray.origin.z);
  rayhit.ray.dir_x = static_cast<float>(ray.direction.x);
  rayhit.ray.dir_y = static_cast<float>(ray.direction.y);
  rayhit.ray.dir_z = static_cast<float>(ray.direction.z);
  rayhit.ray.tnear = 0;
  rayhit.ray.tfar = static_cast<float>(t_max) * 1.0001f;
  rayhit.ray.mask = ~0u;
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return rayhit;
}

}  // namespace isolux
