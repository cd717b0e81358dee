// Materials, textures and lights.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "isolux/formats/colorimetry.h"
#include "isolux/formats/pbrt/directives.h"
#include "isolux/scene/spelling.h"

namespace isolux::pbrt {

using std::numbers::pi;

std::optional<Rgb> Directives::color(const Parameters& parameters, std::string_view name) const {
  const Parameter* const p = parameters.find(name);
  if (!p || p->type != "texture") return parameters.color(name);
  const auto found = textures_.find(parameters.text(name));
  if (found == textures_.end()) {
    p->fail(fmt::format("there is no texture {}", in_quotes(parameters.text(name))));
  }
  return found->second;
}

void Directives::texture(const Token& directive, Lexer& lexer) {
  const std::string name = take_text(directive, lexer);
  take_text(directive, lexer);
  const std::string kind = take_text(directive, lexer);
  const Parameters parameters(lexer);
  const auto or_gray = [&](std::string_view key, double otherwise) {
    return color(parameters, key).value_or(gray(otherwise));
  };
  Rgb mean = gray(0.5);
  if (kind == "constant") {
    mean = or_gray("value", 1);
  } else if (kind == "scale") {
    mean = or_gray("tex", 1) * or_gray("tex1", 1) * or_gray("tex2", 1) * or_gray("scale", 1);
  } else if (kind == "checkerboard") {
    mean = (or_gray("tex1", 1) + or_gray("tex2", 0)) * 0.5;
    assembly_.notes().add("textures: their mean color alone is kept");
  } else if (kind == "imagemap" && parameters.find("filename")) {
    const std::string file(parameters.text("filename"));
    mean = images_.mean_color_of(file, includes_, assembly_.notes()) * or_gray("scale", 1);
  } else {
    assembly_.notes().add("textures that are computed: gray of 0.5");
  }
  textures_[name] = mean;
}

Look Directives::look_of(std::string_view kind, const Parameters& parameters,
                         const std::string& name) {
  constexpr std::array<std::string_view, 3> kDiffuse = {"diffuse", "matte", ""};
  if (std::find(kDiffuse.begin(), kDiffuse.end(), kind) == kDiffuse.end()) {
    assembly_.notes().add("materials that are not diffuse: taken as diffuse");
  }
  Look look{name, gray(0.5), {}, true};
  for (const std::string_view key : {"reflectance", "Kd", "color"}) {
    if (!parameters.find(key)) continue;
    if (const auto found = color(parameters, key)) {
      look.reflectance = *found;
    } else {
      assembly_.notes().add("reflectances as a spectrum: gray of 0.5");
    }
  }
  return look;
}

void Directives::material(const Token& directive, Lexer& lexer) {
  const std::string name = take_text(directive, lexer);
  const Parameters parameters(lexer);
  if (directive.is("Material")) {
    state_.look = look_of(name, parameters, name.empty() ? "unnamed" : name);
  } else {
    materials_[name] = look_of(parameters.text("type"), parameters, name);
  }
}

void Directives::named_material(const Token& directive, Lexer& lexer) {
  const Token name = lexer.peek();
  const auto found = materials_.find(take_text(directive, lexer));
  if (found == materials_.end()) {
    std::vector<std::string_view> names;
    for (const auto& [key, look] : materials_) names.push_back(key);
    name.fail(fmt::format("there is no material {}: {}", in_quotes(name.text),
                          suggestion(name.text, names)));
  }
  state_.look = found->second;
}

void Directives::area_light(const Token& directive, Lexer& lexer) {
  take_text(directive, lexer);
  const Parameters parameters(lexer);
  const auto radiance = color(parameters, "L");
  if (parameters.find("L") && !radiance) {
    assembly_.notes().add("lights given by a spectrum: white of radiance 1");
  }
  const Rgb scale = color(parameters, "scale").value_or(gray(1));
  state_.emitted = luminance_of_radiance(radiance.value_or(gray(1)) * scale) * pi;
  state_.flux = std::max(parameters.number("power").value_or(0), 0.0);
  if (parameters.flag("twosided")) {
    assembly_.notes().left_out("twosided", "lights shine from the front alone");
  }
}

void Directives::light(const Token& directive, Lexer& lexer) {
  const std::string kind = take_text(directive, lexer);
  const Parameters parameters(lexer);
  if (kind != "point" && kind != "spot" && kind != "distant") {
    return assembly_.notes().add("lights other than area, point, spot and distant: left out");
  }
  const bool distant = kind == "distant";
  if (parameters.find("power") || parameters.find("illuminance")) {
    assembly_.notes().add("'power' and 'illuminance' of lights without a surface: left out");
  }
  const Rgb value = color(parameters, distant ? "L" : "I").value_or(gray(1)) *
                    color(parameters, "scale").value_or(gray(1));
  const Vec3 from = parameters.point("from").value_or(Vec3{});
  const Vec3 to = parameters.point("to").value_or(Vec3{0, 0, 1});
  Source source;
  source.name = kind;
  source.intensity = luminance_of_radiance(value);
  source.position = state_.map.point(from);
  const Vec3 way = state_.map.vector(to - from);
  if (kind != "point") {
    if (!(length(way) > 0)) directive.fail("'from' and 'to' of a light must differ");
    source.direction = normalized(way);
  }
  if (distant) source.kind = Source::Kind::directional;
  if (kind == "spot") {
    source.dark_angle = parameters.number("coneangle").value_or(30);
    source.full_angle =
        std::max(source.dark_angle - parameters.number("conedeltaangle").value_or(5), 0.0);
    if (!(source.dark_angle > 0 && source.dark_angle <= 180 &&
          source.full_angle < source.dark_angle)) {
      directive.fail("'coneangle' must lie between 0 and 180, and 'conedeltaangle' be positive");
    }
    assembly_.notes().add("the edge of spots: fades by the law of glTF");
  }
  assembly_.sources().push_back(source);
}

}  // namespace isolux::pbrt
