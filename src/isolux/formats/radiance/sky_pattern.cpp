#include "isolux/formats/radiance/sky_pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "isolux/formats/transform.h"
#include "isolux/scene/spelling.h"

namespace isolux::radiance {
namespace {

using std::numbers::pi;

using Kind = SkyPattern::Kind;

constexpr int kClear = 12, kOvercast = 16, kUniform = 5;  ///< types of the CIE

Vec3 direction(const Primitive& p, std::size_t i) {
  const Vec3 d = normalized({p.number(i), p.number(i + 1), p.number(i + 2)});
  if (length(d) > 0) return d;
  p.numbers.fail(i + 1, "the direction of the sun must not be zero");
}

std::optional<SkyPattern> read_skybr(const Primitive& p) {
  p.expect_numbers(3, 7, "type zenith ground, and for types 1 and 4 normalization and sun");
  constexpr Kind kKinds[] = {Kind::clear, Kind::overcast, Kind::uniform, Kind::intermediate};
  const double type = p.number(0);
  if (!(type == 1 || type == 2 || type == 3 || type == 4)) return std::nullopt;
  SkyPattern pattern;
  pattern.kind = kKinds[static_cast<std::size_t>(type) - 1];
  pattern.factor = p.number(1);
  pattern.ground = p.number(2);
  if (pattern.kind == Kind::clear || pattern.kind == Kind::intermediate) {
    p.expect_numbers(7, 7, "type zenith ground normalization, and the sun's x y z");
    pattern.normalization = p.number(3);
    pattern.sun = direction(p, 4);
  }
  return pattern;
}

SkyPattern read_perez(const Primitive& p, bool colored) {
  p.expect_numbers(10, colored ? 22 : 10, "factor ground a b c d e, and the sun's x y z");
  SkyPattern pattern;
  pattern.kind = Kind::perez;
  pattern.factor = p.number(0);
  pattern.ground = p.number(1);
  pattern.perez = {p.number(2), p.number(3), p.number(4), p.number(5), p.number(6)};
  pattern.sun = direction(p, 7);
  pattern.colored = colored;
  return pattern;
}

/// Calls `f` with cos Z and cos χ of directions that each stand for the same part of ∫ cos Z dω.
template <typename F>
void for_directions(double cos_sun, F f) {
  constexpr int kGrid = 24;
  const double sin_sun = std::sqrt(std::max(0.0, 1 - cos_sun * cos_sun));
  for (int i = 0; i < kGrid; ++i) {
    const double squared = (i + 0.5) / kGrid;
    const double sine = std::sqrt(squared), cosine = std::sqrt(1 - squared);
    for (int k = 0; k < kGrid; ++k) {
      const double azimuth = pi * (k + 0.5) / kGrid;
      f(cosine, cosine * cos_sun + sine * sin_sun * std::cos(azimuth));
    }
  }
}

/// Radiance's intermediate sky (skybright.cal), before its normalization.
double intermediate(double cos_z, double cos_chi, double cos_sun) {
  const double z = std::acos(std::clamp(cos_z, -1.0, 1.0));
  const double chi = std::acos(std::clamp(cos_chi, -1.0, 1.0));
  const double sun = std::acos(std::clamp(cos_sun, -1.0, 1.0));
  const double height =
      (1.35 * std::sin(5.631 - 3.59 * z) + 3.12) * std::sin(4.396 - 2.6 * sun) + 6.37 - z;
  return height / 2.326 * std::exp(-0.563 * chi * ((2.629 - z) * (1.562 - sun) + 0.812));
}

/// Sets distribution and zenith to those of the standard sky that is nearest.
void fit_intermediate(const SkyPattern& pattern, PatternedSky& result) {
  const double cos_sun = dot(pattern.sun, pattern.up);
  double wanted = 0, least = std::numeric_limits<double>::infinity();
  for_directions(cos_sun, [&](double z, double chi) { wanted += intermediate(z, chi, cos_sun); });
  for (int type = 1; type < kSkyTypes; ++type) {
    const SkyDistribution standard = standard_sky(type);
    const auto value = [&](double z, double chi) {
      return standard.gradation(z) * standard.indicatrix(chi);
    };
    double sum = 0, error = 0;
    for_directions(cos_sun, [&](double z, double chi) { sum += value(z, chi); });
    for_directions(cos_sun, [&](double z, double chi) {
      error += std::pow(value(z, chi) * wanted / sum - intermediate(z, chi, cos_sun), 2);
    });
    if (!(error < least)) continue;
    least = error;
    result.nearest_type = type;
    result.sky.distribution = standard;
    result.sky.zenith = gray(value(1, cos_sun) * wanted / sum);
  }
  result.sky.zenith *= pattern.factor / pattern.normalization;
}

/// Whether scenes may have such a sky.
bool is_sound(const Sky& sky) {
  const auto sound = [](double value) { return value >= 0 && std::isfinite(value); };
  if (!sound(sky.zenith.r) || !sound(sky.ground.r)) return false;
  if (sky.zenith.r == 0) return true;
  const auto& [a, b, c, d, e, slope] = sky.distribution;
  if (b > 0) return false;
  for (const double coefficient : {a, b, c, d, e}) {
    if (!(std::abs(coefficient) <= kLargestSkyCoefficient)) return false;
  }
  const LuminanceRange range = relative_range(sky.distribution, dot(sky.sun, sky.up));
  return range.least >= 0 && range.most <= kLargestContrast;
}

}  // namespace

double solid_angle(double degrees) {
  return 4 * pi * std::pow(std::sin(0.25 * degrees * pi / 180), 2);
}

std::optional<SkyPattern> read_sky_pattern(const Primitive& p, const Affine& map) {
  // The words are functions and their file, then where they stand.
  const Statement& words = p.strings;
  const auto is = [&](std::size_t i, std::string_view word) {
    return i < words.size() && words.word(i) == word;
  };
  const auto file_is = [&](std::size_t i, std::string_view name) {
    return i < words.size() && words.word(i).substr(words.word(i).rfind('/') + 1) == name;
  };
  std::optional<SkyPattern> pattern;
  std::size_t at = 3;
  if (p.type() == "brightfunc" && is(1, "skybr") && file_is(2, "skybright.cal")) {
    pattern = read_skybr(p);
  } else if (p.type() == "brightfunc" && is(1, "skybright") && file_is(2, "perezlum.cal")) {
    pattern = read_perez(p, false);
  } else if (p.type() == "colorfunc" && is(1, "skybright_r") && is(2, "skybright_g") &&
             is(3, "skybright_b") && file_is(4, "perezlum_c.cal")) {
    pattern = read_perez(p, true);
    at = 5;
  }
  if (!pattern) return pattern;
  const std::vector<Affine> local = read_transform(words, at, 1);
  if (at < words.size()) {
    words.fail(at, fmt::format("{} is no transform", in_quotes(words.word(at))));
  }
  const Affine placement = map * local.front();
  const auto placed = [&](const Vec3& way) { return unit_vector(placement.vector(way)); };
  const bool has_sun = pattern->kind != Kind::overcast && pattern->kind != Kind::uniform;
  pattern->up = placed({0, 0, 1});
  pattern->sun = has_sun ? placed(pattern->sun) : pattern->up;
  return pattern;
}

std::optional<PatternedSky> sky_of(const SkyPattern& pattern) {
  PatternedSky result;
  Sky& sky = result.sky;
  sky.up = pattern.up;
  sky.sun = pattern.sun;
  sky.ground = gray(pattern.ground);
  const double cos_sun = dot(sky.sun, sky.up);
  switch (pattern.kind) {
    case Kind::uniform:
      sky.distribution = standard_sky(kUniform);
      sky.zenith = gray(pattern.factor);
      break;
    case Kind::overcast:  // factor (1 + 2 cos Z) / 3
      sky.distribution = standard_sky(kOvercast);
      sky.zenith = gray(pattern.factor);
      break;
    case Kind::clear: {
      // factor (0.91 + 10 exp(−3 χ) + 0.45 cos² χ) (1 − exp(−0.32 / cos Z)) / normalization; the
      // CIE writes 1 − 10 exp(−3 π/2), which is 0.91017, for 0.91.
      sky.distribution = standard_sky(kClear);
      const double to_zenith = sky.distribution.gradation(1) * sky.distribution.indicatrix(cos_sun);
      sky.zenith = gray(pattern.factor * to_zenith / pattern.normalization);
      break;
    }
    case Kind::intermediate:
      fit_intermediate(pattern, result);
      break;
    case Kind::perez: {
      // 1 + c exp(d χ) + e cos² χ = m (1 + c/m (exp(d χ) − exp(d π/2)) + e/m cos² χ)
      const double m = 1 + pattern.perez.c * std::exp(pattern.perez.d * pi / 2);
      sky.distribution = pattern.perez;
      sky.distribution.c /= m;
      sky.distribution.e /= m;
      const double to_zenith = sky.distribution.gradation(1) * sky.distribution.indicatrix(cos_sun);
      sky.zenith = gray(pattern.factor * m * to_zenith);
      break;
    }
  }
  if (sky.zenith.r == 0) sky.distribution = standard_sky(kUniform);
  return is_sound(sky) ? std::optional(result) : std::nullopt;
}

}  // namespace isolux::radiance
