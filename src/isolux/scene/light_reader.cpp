#include "isolux/scene/light_reader.h"

#include <fmt/format.h>

#include "isolux/scene/scene.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

constexpr double kLargestExitance = 1e12;   ///< lm/m², some hundred times that of the sun
constexpr double kLargestIntensity = 1e15;  ///< cd, or lx

/// The colour that a light's amount is multiplied by: its luminance is 1.
Rgb read_hue(const Fields& fields) {
  const std::optional<Value> value = fields.find("color");
  if (!value) return gray(1);
  const Rgb color = value->color();
  const double largest = max_channel(color);
  if (!(largest > 0)) value->fail("'color' must not be black: give a light of no colour flux 0");
  const Rgb scaled{color.r / largest, color.g / largest, color.b / largest};
  return scaled / luminance(scaled);
}

double read_flux(const Value& value) {
  const double flux = value.number();
  if (flux < 0) value.fail("'flux' must not be negative: give lumens from 0 up");
  return flux;
}

/// `intensity` (cd), or a `flux` (lm) that the whole beam shares.
void read_strength(const Value& value, const Fields& fields, Source& source) {
  const std::optional<Value> intensity = fields.find("intensity"), flux = fields.find("flux");
  if (intensity.has_value() == flux.has_value()) {
    value.fail(fmt::format("{} must have one of 'intensity' (cd) and 'flux' (lm)",
                           in_quotes(value.label())));
  }
  if (intensity) {
    source.intensity = read_amount(fields, "intensity");
  } else {
    source.intensity = gray(1);
    source.intensity = read_hue(fields) * (read_flux(*flux) / luminous_flux(source));
  }
}

void read_point(const Value& value, Source& source) {
  const Fields fields(value, {"position", "intensity", "flux", "color"});
  source.position = fields.require("position").point();
  read_strength(value, fields, source);
}

void read_spot(const Value& value, Source& source) {
  const Fields fields(value,
                      {"position", "direction", "look_at", "angles", "intensity", "flux", "color"});
  source.position = fields.require("position").point();
  const std::optional<Value> direction = fields.find("direction"), look_at = fields.find("look_at");
  if (direction.has_value() == look_at.has_value()) {
    value.fail("'spot' must have one of 'direction' and 'look_at'");
  }
  const Vec3 way = direction ? direction->direction() : look_at->point() - source.position;
  if (look_at && !(length(way) > 1e-9)) look_at->fail("'look_at' must differ from 'position'");
  source.direction = unit_vector(way);
  const Value angles = fields.require("angles");
  const std::vector<Value> both = angles.items(2, 2);
  const double full = both[0].number(), dark = both[1].number();
  if (!(full >= 0 && full <= dark && dark >= 0.1 && dark <= 180)) {
    angles.fail(
        "'angles' must rise from 0 to 180: the beam is full up to the first (degrees off its "
        "middle) and ends at the second, at least 0.1, such as [20, 30]");
  }
  source.full_angle = full;
  source.dark_angle = dark;
  read_strength(value, fields, source);
}

void read_directional(const Value& value, Source& source) {
  const Fields fields(value, {"direction", "illuminance", "color"});
  source.kind = Source::Kind::directional;
  source.direction = unit_vector(fields.require("direction").direction());
  source.intensity = read_amount(fields, "illuminance");
}

}  // namespace

Rgb read_amount(const Fields& fields, std::string_view key) {
  const Value value = fields.require(key);
  if (value.is_list() && fields.find("color")) {
    value.fail(
        fmt::format("{} in three channels has its colour already: remove 'color'", in_quotes(key)));
  }
  return value.color() * read_hue(fields);
}

Source read_source(const Value& light, std::size_t number) {
  using Read = void (*)(const Value&, Source&);
  constexpr std::pair<std::string_view, Read> kKinds[] = {
      {"point", read_point}, {"spot", read_spot}, {"directional", read_directional}};
  const Fields fields(light, {"name", "point", "spot", "directional"});
  Source source;
  std::string_view found;
  for (const auto& [kind, read] : kKinds) {
    const std::optional<Value> value = fields.find(kind);
    if (!value) continue;
    if (!found.empty()) value->fail("a second kind in one light: make two lights of them");
    found = kind;
    read(*value, source);
    if (!(max_channel(source.intensity) <= kLargestIntensity)) {
      value->fail("more than 1e15 cd or lx: check its numbers");
    }
  }
  if (found.empty()) light.fail("a light here is one of 'point', 'spot' and 'directional'");
  const std::optional<Value> name = fields.find("name");
  source.name = name ? name->text() : fmt::format("{} {}", found, number);
  return source;
}

namespace {

Rgb read_emission_of(const Value& emission, const Shape* shape) {
  const Fields fields(emission, {"exitance", "flux", "color"});
  const std::optional<Value> exitance = fields.find("exitance"), flux = fields.find("flux");
  if (exitance.has_value() == flux.has_value()) {
    emission.fail("'emission' must have one of 'exitance' (lm/m2) and 'flux' (lm)");
  }
  if (exitance && exitance->is_list() && fields.find("color")) {
    exitance->fail("'exitance' in three channels has its colour already: remove 'color'");
  }
  Rgb emitted;
  if (exitance) {
    emitted = exitance->color() * read_hue(fields);
  } else {
    const double area = shape ? surface_area(*shape).value_or(0) : 0;
    if (!(area > 0)) flux->fail("'flux' needs a surface with an area: give 'exitance' instead");
    emitted = read_hue(fields) * (read_flux(*flux) / area);
  }
  if (!(max_channel(emitted) <= kLargestExitance)) {
    (exitance ? *exitance : *flux).fail("more than 1e12 lm/m2 leave this light: check its numbers");
  }
  return emitted;
}

}  // namespace

Rgb read_emission(const Value& emission, const Shape& shape) {
  return read_emission_of(emission, &shape);
}

Rgb read_emission(const Value& emission) { return read_emission_of(emission, nullptr); }

}  // namespace isolux
