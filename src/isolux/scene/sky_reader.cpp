#include "isolux/scene/sky_reader.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "isolux/scene/light_reader.h"

namespace isolux {
namespace {

constexpr double kDarkest = 1e-9;  ///< cd/m² or lx: less is 0 or a mistake

int read_type(const Value& value) {
  constexpr std::array kNamed{5, 16, 12};
  if (value.is_text()) return kNamed[value.choice({"uniform", "overcast", "clear"})];
  return value.integer(1, kSkyTypes);
}

SkyDistribution read_coefficients(const Value& value) {
  const std::vector<Value> items = value.items(5, 5);
  std::array<double, 5> numbers{};
  for (std::size_t i = 0; i < items.size(); ++i) {
    numbers[i] = items[i].number();
    if (!(std::abs(numbers[i]) <= kLargestSkyCoefficient)) {
      items[i].fail(fmt::format("the coefficients of a 'distribution' lie within {}: check them",
                                kLargestSkyCoefficient));
    }
  }
  const auto& [a, b, c, d, e] = numbers;
  if (b > 0) {
    items[1].fail(
        "the second number of 'distribution', b, must not be more than 0: the horizon would be "
        "infinitely bright");
  }
  return {a, b, c, d, e};
}

/// Sets where the zenith and the sun are.
void read_directions(const Value& value, const Fields& fields, Sky& sky) {
  if (const auto up = fields.find("up")) sky.up = unit_vector(up->direction());
  const std::optional<Value> sun = fields.find("sun");
  const bool needed = sky.distribution.depends_on_sun();
  if (needed && !sun) {
    value.fail(
        "'sky' lacks the key 'sun': give the direction towards the sun, around which such a sky "
        "is brighter");
  }
  sky.sun = sun ? unit_vector(sun->direction()) : sky.up;
}

}  // namespace

Sky read_sky(const Value& value) {
  const Fields fields(
      value, {"type", "distribution", "sun", "illuminance", "zenith", "color", "ground", "up"});
  const auto type = fields.find("type"), coefficients = fields.find("distribution");
  if (type.has_value() == coefficients.has_value()) {
    value.fail("'sky' must have one of 'type', such as overcast, and 'distribution'");
  }
  const auto illuminance = fields.find("illuminance"), zenith = fields.find("zenith");
  if (illuminance.has_value() == zenith.has_value()) {
    value.fail("'sky' must have one of 'illuminance' (lx) and 'zenith' (cd/m2)");
  }
  const Value& shape = type ? *type : *coefficients;
  Sky sky;
  sky.distribution = type ? standard_sky(read_type(*type)) : read_coefficients(*coefficients);
  read_directions(value, fields, sky);

  const double cos_sun = dot(sky.sun, sky.up);
  const LuminanceRange range = relative_range(sky.distribution, cos_sun);
  if (!std::isfinite(range.most)) {
    shape.fail("the zenith of this sky has no luminance: check its 'distribution'");
  }
  if (range.least < 0) {
    shape.fail("this sky has directions of negative luminance: check its 'distribution'");
  }
  if (!(range.most <= kLargestContrast)) {
    shape.fail(fmt::format(
        "this sky is somewhere more than {} times as bright as in the zenith: check its "
        "'distribution'",
        kLargestContrast));
  }
  sky.zenith = read_amount(fields, illuminance ? "illuminance" : "zenith");
  if (max_channel(sky.zenith) > 0 && max_channel(sky.zenith) < kDarkest) {
    (illuminance ? *illuminance : *zenith).fail("less than 1e-9: give 0 for no light");
  }
  if (illuminance) {
    sky.zenith = sky.zenith / horizontal_illuminance(sky.distribution, cos_sun);
  }
  if (!(range.most * max_channel(sky.zenith) <= kBrightestSky)) {
    (illuminance ? *illuminance : *zenith)
        .fail("the sky is brighter than 1e9 cd/m2 in some directions: check its numbers");
  }
  if (const auto ground = fields.find("ground")) {
    sky.ground = ground->color();
    if (max_channel(sky.ground) > 0 && max_channel(sky.ground) < kDarkest) {
      ground->fail("less than 1e-9: give 0 for no light");
    }
    if (!(max_channel(sky.ground) <= kBrightestSky)) {
      ground->fail("'ground' is brighter than 1e9 cd/m2: check its numbers");
    }
  }
  return sky;
}

}  // namespace isolux
