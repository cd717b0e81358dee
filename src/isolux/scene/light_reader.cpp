#include "isolux/scene/light_reader.h"

#include "isolux/scene/scene.h"

namespace isolux {
namespace {

constexpr double kLargestExitance = 1e12;  ///< lm/m², some hundred times that of the sun

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

}  // namespace

Rgb read_emission(const Value& emission, const Shape& shape) {
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
    const double area = surface_area(shape).value_or(0);
    if (!(area > 0)) flux->fail("'flux' needs a surface with an area: give 'exitance' instead");
    emitted = read_hue(fields) * (read_flux(*flux) / area);
  }
  if (!(max_channel(emitted) <= kLargestExitance)) {
    (exitance ? *exitance : *flux).fail("more than 1e12 lm/m2 leave this light: check its numbers");
  }
  return emitted;
}

}  // namespace isolux
