#include "isolux/formats/radiance/photometry.h"

namespace isolux {

double radiance_brightness(const Rgb& color) {
  return 0.265 * color.r + 0.670 * color.g + 0.065 * color.b;
}

Rgb luminance_of_radiance(const Rgb& radiance) {
  const double bright = radiance_brightness(radiance);
  return bright > 0 ? radiance * (kRadianceEfficacy * bright / luminance(radiance)) : Rgb{};
}

Rgb radiance_of_luminance(const Rgb& seen) {
  const double bright = radiance_brightness(seen);
  return bright > 0 ? seen * (luminance(seen) / (kRadianceEfficacy * bright)) : Rgb{};
}

}  // namespace isolux
