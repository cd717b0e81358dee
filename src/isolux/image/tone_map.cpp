#include "isolux/image/tone_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace isolux {
namespace {

constexpr double kMiddle = 0.35;
constexpr double kBright = 0.02;  // part of the lit pixels that may be lamps
constexpr double kHeadroom = 1.2;

struct Adaptation {
  double exposure = 0;  // L per cd/m²
  double white = 1;     // L_w
};

Adaptation adapt(const Picture& picture) {
  std::vector<double> lit;
  for (const Rgb& c : picture.pixels) {
    const double y = luminance(c);
    if (std::isfinite(y) && y > 0) lit.push_back(y);
  }
  if (lit.empty()) return {};
  std::sort(lit.begin(), lit.end());
  const auto kept =
      static_cast<std::size_t>(std::ceil(static_cast<double>(lit.size()) * (1 - kBright)));
  double sum = 0;
  for (std::size_t i = 0; i < kept; ++i) sum += std::log(lit[i]);
  const double key = std::exp(sum / static_cast<double>(kept));
  const double exposure = kMiddle / key;
  return {exposure, std::max(1.0, kHeadroom * exposure * lit[kept - 1])};
}

}  // namespace

Picture tone_map(const Picture& picture) {
  const Adaptation eye = adapt(picture);
  Picture display = picture;
  for (Rgb& c : display.pixels) {
    const double l = eye.exposure * luminance(c);
    if (!is_finite(c) || !(l > 0)) {
      c = {};
      continue;
    }
    const double shown = l >= eye.white ? 1 : l * (1 + l / (eye.white * eye.white)) / (1 + l);
    c *= eye.exposure * shown / l;
    c = {std::clamp(c.r, 0.0, 1.0), std::clamp(c.g, 0.0, 1.0), std::clamp(c.b, 0.0, 1.0)};
  }
  return display;
}

}  // namespace isolux
