#include "isolux/formats/radiance/write_sky.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "isolux/core/affine.h"
#include "isolux/formats/colorimetry.h"
#include "isolux/formats/radiance/sky_pattern.h"

namespace isolux::radiance {
namespace {

using std::numbers::pi;

constexpr double kSunWidth = 0.5;  ///< degrees

std::string primitive(const std::string& modifier, const std::string& type, const std::string& name,
                      const std::string& words, const std::string& numbers) {
  return fmt::format("{} {} {}\n{}\n0\n{}\n\n", modifier, type, name, words, numbers);
}

std::string glow(const std::string& modifier, const std::string& name, const Rgb& luminance) {
  const Rgb radiance = radiance_of_luminance(luminance);
  return primitive(modifier, "glow", name, "0",
                   fmt::format("4 {} {} {} 0", radiance.r, radiance.g, radiance.b));
}

std::string source(const std::string& modifier, const std::string& name, const Vec3& toward,
                   double degrees) {
  return primitive(modifier, "source", name, "0",
                   fmt::format("4 {} {} {} {}", toward.x, toward.y, toward.z, degrees));
}

/// The distribution in parts of its value in the zenith, as a pattern; nothing where there is no
/// such function. `ground` is what Radiance mixes with the sky next to the horizon.
std::optional<std::string> pattern(const Sky& sky, double ground, const std::string& name) {
  const SkyDistribution& d = sky.distribution;
  // The zenith of the function is +z: it is tilted towards x, then turned about z.
  const double tilt = std::atan2(std::hypot(sky.up.x, sky.up.y), sky.up.z);
  const double turn = std::atan2(sky.up.y, sky.up.x);
  const Affine back = Affine::rotate({0, 1, 0}, -tilt) * Affine::rotate({0, 0, 1}, -turn);
  const Vec3 sun = tilt == 0 ? sky.sun : back.vector(sky.sun);
  const std::string placed =
      tilt == 0 ? "" : fmt::format(" -ry {} -rz {}", tilt * 180 / pi, turn * 180 / pi);
  const auto words = [&](std::string_view function) {
    return fmt::format("{} {}{}", placed.empty() ? 2 : 6, function, placed);
  };
  if (d.slope == 2 && d.a == 0 && d.c == 0 && d.e == 0) {
    return primitive("void", "brightfunc", name, words("skybr skybright.cal"),
                     fmt::format("3 2 1 {}", ground));
  }
  // 1 + c (exp(d χ) − exp(d π/2)) + e cos² χ = m (1 + c/m exp(d χ) + e/m cos² χ)
  const double m = 1 - d.c * std::exp(d.d * pi / 2);
  const double factor = m / (d.gradation(1) * d.indicatrix(dot(sky.sun, sky.up)));
  const double c = d.c / m, e = d.e / m;
  if (d.slope != 0 || !std::isfinite(factor) || !std::isfinite(c) || !std::isfinite(e)) {
    return std::nullopt;
  }
  return primitive("void", "brightfunc", name, words("skybright perezlum.cal"),
                   fmt::format("10 {} {} {} {} {} {} {} {} {} {}", factor, ground, d.a, d.b, c, d.d,
                               e, sun.x, sun.y, sun.z));
}

std::string sky_text(const Sky& sky, Identifiers& names, std::vector<std::string>& notes) {
  const double zenith = luminance(sky.zenith);
  const std::string function = names.next("skyfunc"), above = names.next("sky_glow"),
                    below = names.next("ground_glow");
  const auto distribution = pattern(sky, zenith > 0 ? luminance(sky.ground) / zenith : 0, function);
  if (!distribution) {
    notes.emplace_back("the sky is left out: Radiance has no function for its distribution");
    return {};
  }
  return *distribution + glow(function, above, sky.zenith) + source(above, "sky", sky.up, 180) +
         glow("void", below, sky.ground) + source(below, "ground", -sky.up, 180);
}

}  // namespace

std::string light_from_infinity(const Scene& scene, Identifiers& names,
                                std::vector<std::string>& notes) {
  std::string text;
  for (const Source& light : scene.sources) {
    if (light.kind != Source::Kind::directional) continue;
    const std::string material = names.next(light.name);
    const Rgb radiance = radiance_of_luminance(light.intensity / solid_angle(kSunWidth));
    text += primitive("void", "light", material, "0",
                      fmt::format("3 {} {} {}", radiance.r, radiance.g, radiance.b));
    text += source(material, identifier(light.name), -light.direction, kSunWidth);
  }
  if (scene.sky && scene.sky->shines()) text += sky_text(*scene.sky, names, notes);
  return text;
}

}  // namespace isolux::radiance
