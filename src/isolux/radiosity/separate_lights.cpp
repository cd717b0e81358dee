#include "isolux/radiosity/separate_lights.h"

#include "isolux/core/color.h"

namespace isolux {
namespace {

using Index = std::uint32_t;

/// What an object adds to the balance of light.
struct Share {
  double flux = 0;       ///< emitted, lm
  double absorbing = 0;  ///< (1 − ρ) × area, m²
};

Share share_of(const Scene& scene, Index index) {
  const Object& object = scene.objects[index];
  std::optional<double> area = surface_area(*object.shape);
  if (!area) {
    const Bounds box = object.shape->bounds();
    const Vec3 d = box.upper - box.lower;
    area = 2 * (d.x * d.y + d.y * d.z + d.z * d.x);
  }
  const int sides = object.sides == Sides::both && !object.shape->solid() ? 2 : 1;
  return {luminance(object.exitance) * *area,
          (1 - luminance(scene.material_of(index).reflectance)) * sides * *area};
}

}  // namespace

std::vector<std::uint8_t> separate_lights(const Scene& scene) {
  constexpr double kBright = 1.5;
  std::vector<Share> shares;
  Share all;
  for (Index i = 0; i < scene.objects.size(); ++i) {
    shares.push_back(share_of(scene, i));
    all.flux += shares[i].flux;
    all.absorbing += shares[i].absorbing;
  }
  std::vector<std::uint8_t> separate(scene.objects.size(), 0);
  for (Index i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!object.emits()) continue;
    const Share others{all.flux - shares[i].flux, all.absorbing - shares[i].absorbing};
    separate[i] = luminance(object.exitance) * others.absorbing >= kBright * others.flux &&
                  object.shape->triangulate(object.shape->bounds().diagonal());
  }
  return separate;
}

}  // namespace isolux
