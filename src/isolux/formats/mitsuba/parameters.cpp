#include "isolux/formats/mitsuba/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "isolux/formats/colorimetry.h"
#include "isolux/formats/texture.h"
#include "isolux/scene/length.h"
#include "isolux/scene/spelling.h"

namespace isolux::mitsuba {
namespace {

constexpr std::string_view kBlanks = " \t\r\n,";

double parsed(const Element& element, std::string_view word) {
  const auto value = parse_number(word);
  if (!value || !std::isfinite(*value)) {
    element.fail(fmt::format("expected a finite number, not {}", in_quotes(word)));
  }
  return *value;
}

double one_number(const Element& element, std::string_view attribute) {
  const std::vector<double> list = numbers(element, attribute);
  if (list.size() != 1) element.fail(fmt::format("{} must be one number", attribute));
  return list[0];
}

/// The words of a text between blanks or commas.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(kBlanks, at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

/// x, y and z as attributes, each `otherwise` where it is not there, or all in value="...".
Vec3 triple(const Element& element, double otherwise) {
  if (element.find("value")) {
    const std::vector<double> list = numbers(element, "value");
    if (list.size() != 3) element.fail("value must be three numbers");
    return {list[0], list[1], list[2]};
  }
  const auto part = [&](std::string_view axis) {
    return element.find(axis) ? one_number(element, axis) : otherwise;
  };
  return {part("x"), part("y"), part("z")};
}

Vec3 triple_of(const Element& element, std::string_view attribute) {
  element.need(attribute);
  const std::vector<double> list = numbers(element, attribute);
  if (list.size() != 3) element.fail(fmt::format("{} must be three numbers", attribute));
  return {list[0], list[1], list[2]};
}

Affine look_at(const Element& step) {
  const Vec3 origin = triple_of(step, "origin");
  const Vec3 ahead = normalized(triple_of(step, "target") - origin);
  const Vec3 up = step.find("up") ? triple_of(step, "up") : Vec3{0, 0, 1};
  const Vec3 left = normalized(cross(normalized(up), ahead));
  if (!(length(left) > 0.5)) step.fail("<lookat> needs a target, and 'up' not along the view");
  const Vec3 over = cross(ahead, left);
  return {
      {Vec3{left.x, over.x, ahead.x}, Vec3{left.y, over.y, ahead.y}, Vec3{left.z, over.z, ahead.z}},
      origin};
}

/// Row by row, four by four or three by three.
Affine matrix(const Element& step) {
  const std::vector<double> m = numbers(step, "value");
  if (m.size() == 9) return {{Vec3{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}}, {}};
  if (m.size() != 16) step.fail("a matrix has 16 or 9 numbers");
  if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
    step.fail("the last row of a matrix must be 0 0 0 1");
  }
  return {{Vec3{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}, {m[3], m[7], m[11]}};
}

Affine map_of(const Element& step) {
  if (step.is("translate")) return Affine::translate(triple(step, 0));
  if (step.is("scale")) {
    const bool even = step.find("value") && numbers(step, "value").size() == 1;
    return Affine::scale(even ? Vec3{1, 1, 1} * one_number(step, "value") : triple(step, 1));
  }
  if (step.is("rotate")) {
    const Vec3 axis = triple(step, 0);
    if (!(length(axis) > 0)) step.fail("the axis of <rotate> must not be zero");
    step.need("angle");
    return Affine::rotate(axis, one_number(step, "angle") * std::numbers::pi / 180);
  }
  if (step.is("lookat")) return look_at(step);
  if (step.is("matrix")) return matrix(step);
  step.fail(fmt::format("<{}> is no step of a transform", step.tag));
}

/// "#rrggbb" in the curve of sRGB.
Rgb hexadecimal(const Element& element, std::string_view text) {
  const auto digit = [&](std::size_t i) {
    const std::size_t value = std::string_view("0123456789abcdef0123456789ABCDEF").find(text[i]);
    if (value == std::string_view::npos) element.fail(in_quotes(text) + " is no color");
    return static_cast<double>(value % 16);
  };
  if (text.size() != 7) element.fail(in_quotes(text) + " is no color: write #rrggbb");
  const auto channel = [&](std::size_t i) {
    return linear_of_srgb((16 * digit(i) + digit(i + 1)) / 255);
  };
  return {channel(1), channel(3), channel(5)};
}

Rgb triplet_color(const Element& element) {
  const std::string_view value = element.need("value");
  if (value.starts_with('#')) return hexadecimal(element, value);
  const std::vector<double> list = numbers(element, "value");
  if (list.size() != 1 && list.size() != 3) element.fail("a color has three numbers, or one");
  Rgb color = list.size() == 1 ? gray(list[0]) : Rgb{list[0], list[1], list[2]};
  if (element.is("srgb")) {
    color = {linear_of_srgb(color.r), linear_of_srgb(color.g), linear_of_srgb(color.b)};
  }
  return color;
}

/// "400:0.5, 700:0.7": nanometres and values, linear in between, zero outside.
Rgb sampled_color(const Element& element, const std::vector<std::string_view>& words) {
  constexpr double kFirst = 380, kLast = 780;  // nm, where the eye ends
  std::vector<std::pair<double, double>> samples;
  for (const std::string_view word : words) {
    const std::size_t colon = word.find(':');
    if (colon == word.npos) element.fail("a spectrum is a number, or nanometres:value pairs");
    samples.emplace_back(parsed(element, word.substr(0, colon)),
                         parsed(element, word.substr(colon + 1)));
    if (samples.back().second < 0) element.fail("a spectrum must not be negative");
    if (samples.size() > 1 && !(samples.back().first > samples[samples.size() - 2].first)) {
      element.fail("the wavelengths of a spectrum must rise");
    }
  }
  std::vector<double> values;
  std::size_t after = 0;
  for (double at = kFirst; at <= kLast; ++at) {
    while (after < samples.size() && samples[after].first < at) ++after;
    const bool outside = after == samples.size() || (after == 0 && samples[0].first > at);
    if (outside || after == 0) {
      values.push_back(outside ? 0 : samples[0].second);
      continue;
    }
    const auto& [x0, y0] = samples[after - 1];
    const auto& [x1, y1] = samples[after];
    values.push_back(y0 + (y1 - y0) * ((at - x0) / (x1 - x0)));
  }
  return paled_into_range(rec709(xyz_of_spectrum(kFirst, kLast, values)),
                          std::numeric_limits<double>::infinity());
}

Rgb black_body(const Element& element, double temperature, double scale) {
  if (!(temperature >= 100 && temperature <= 1e6)) {
    element.fail("a temperature lies between 100 and 1000000 K");
  }
  return paled_into_range(rec709(xyz_of_black_body(temperature)) * scale,
                          std::numeric_limits<double>::infinity());
}

std::optional<Rgb> spectrum_color(const Element& element) {
  const std::string_view type = element.text("type");
  if (type == "uniform") return gray(number(element, "value", 1));
  if (type == "d65") return gray(number(element, "scale", 1));
  if (type == "blackbody") {
    return black_body(element, number(element, "temperature", 5000), number(element, "scale", 1));
  }
  if (!type.empty() || element.find("filename")) return std::nullopt;
  const std::vector<std::string_view> words = words_of(element.need("value"));
  if (words.empty()) element.fail("a spectrum is a number, or nanometres:value pairs");
  const bool is_number = words.size() == 1 && words[0].find(':') == std::string_view::npos;
  return is_number ? gray(parsed(element, words[0])) : sampled_color(element, words);
}

}  // namespace

std::vector<double> numbers(const Element& element, std::string_view attribute) {
  std::vector<double> list;
  for (const std::string_view word : words_of(element.need(attribute))) {
    list.push_back(parsed(element, word));
  }
  return list;
}

const Element* find(const Element& object, std::string_view name) {
  const auto found = std::find_if(object.children.begin(), object.children.end(),
                                  [&](const Element& child) { return child.text("name") == name; });
  return found == object.children.end() ? nullptr : &*found;
}

double number(const Element& object, std::string_view name, double otherwise) {
  const Element* const parameter = find(object, name);
  if (!parameter) return otherwise;
  if (!parameter->is("float") && !parameter->is("integer")) {
    parameter->fail(fmt::format("{} must be a <float>", in_quotes(name)));
  }
  return one_number(*parameter, "value");
}

bool flag(const Element& object, std::string_view name) {
  const Element* const parameter = find(object, name);
  if (!parameter) return false;
  const std::string& value = parameter->need("value");
  if (!parameter->is("boolean") || (value != "true" && value != "false")) {
    parameter->fail(fmt::format("{} must be a <boolean>, true or false", in_quotes(name)));
  }
  return value == "true";
}

std::string_view text(const Element& object, std::string_view name) {
  const Element* const parameter = find(object, name);
  if (!parameter) return {};
  if (!parameter->is("string"))
    parameter->fail(fmt::format("{} must be a <string>", in_quotes(name)));
  return parameter->need("value");
}

Vec3 vector(const Element& object, std::string_view name, const Vec3& otherwise) {
  const Element* const parameter = find(object, name);
  if (!parameter) return otherwise;
  if (!parameter->is("point") && !parameter->is("vector")) {
    parameter->fail(fmt::format("{} must be a <point> or a <vector>", in_quotes(name)));
  }
  return triple(*parameter, 0);
}

Affine transform(const Element& object, std::string_view name) {
  Affine map;
  const Element* const parameter = find(object, name);
  if (!parameter) return map;
  if (!parameter->is("transform")) {
    parameter->fail(fmt::format("{} must be a <transform>", in_quotes(name)));
  }
  for (const Element& step : parameter->children) {
    map = map_of(step) * map;
    if (!map.inverse()) step.fail("the transform flattens everything, or is too large");
  }
  return map;
}

std::optional<Rgb> plain_color(const Element& element) {
  std::optional<Rgb> color;
  if (element.is("float")) {
    color = gray(one_number(element, "value"));
  } else if (element.is("rgb") || element.is("srgb")) {
    color = triplet_color(element);
  } else if (element.is("spectrum")) {
    color = spectrum_color(element);
  } else {
    element.fail(fmt::format("<{}> is no color", element.tag));
  }
  if (color && min_channel(*color) < 0) element.fail("a color must not be negative");
  return color;
}

}  // namespace isolux::mitsuba
