#include "isolux/formats/openscad/side_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "isolux/core/file.h"
#include "isolux/scene/length.h"
#include "isolux/scene/light_reader.h"
#include "isolux/scene/part_reader.h"
#include "isolux/scene/spelling.h"

namespace isolux::openscad {
namespace {

constexpr double kMostShown = 0.9;  ///< reflectance of what has a color alone
constexpr double kPlainReflectance = 0.5;

std::string color_name(const Color& color) {
  if (!color) return "uncolored";
  return fmt::format("#{:02x}{:02x}{:02x}", (*color)[0], (*color)[1], (*color)[2]);
}

/// "#rrggbb", or a list of three numbers from 0 to 1 as OpenSCAD has them.
Color read_color(const Value& value) {
  std::array<int, 3> color = {};
  if (value.is_list()) {
    const Vec3 channels = value.vector();
    for (std::size_t i = 0; i < 3; ++i) {
      const double channel = channels[static_cast<int>(i)];
      if (!(channel >= 0 && channel <= 1)) {
        value.fail("channels of a 'color' are from 0 to 1 here, as in the model");
      }
      color[i] = static_cast<int>(std::lround(channel * 255));
    }
    return color;
  }
  const std::string text = value.text();
  std::uint32_t code = 0;
  const char* const end = text.data() + text.size();
  const bool is_code = text.size() == 7 && text[0] == '#' &&
                       std::from_chars(text.data() + 1, end, code, 16).ptr == end && text[1] != '-';
  if (!is_code) value.fail("'color' must be one of the model's: \"#rrggbb\" or [red, green, blue]");
  for (std::size_t i = 0; i < 3; ++i) color[i] = static_cast<int>(code >> (16 - 8 * i) & 255);
  return color;
}

/// The linear value of an 8-bit code of sRGB (IEC 61966-2-1).
double linear(int code) {
  const double x = code / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

Rgb reflectance_of(const Color& color) {
  if (!color) return gray(kPlainReflectance);
  const auto limited = [](int code) { return std::min(linear(code), kMostShown); };
  return {limited((*color)[0]), limited((*color)[1]), limited((*color)[2])};
}

}  // namespace

SideFile::SideFile(const std::filesystem::path& model, Notes& notes) {
  context_.metres_per_unit = 1e-3;
  std::filesystem::path path = model;
  path.replace_extension(".lights.yaml");
  context_.file = path.string();
  if (!std::filesystem::exists(path)) {
    notes.add(
        fmt::format("there is no {} beside the model: nothing shines", path.filename().string()));
    return;
  }
  constexpr std::size_t kLargestFile = std::size_t{1} << 20;  // bytes
  document_ = parse_yaml(read_file(path, kLargestFile), path.string());
  read(Value(context_, *document_.root, "file"));
}

void SideFile::read(const Value& root) {
  const Fields fields(root, {"unit", "materials", "lights", "cameras"});
  if (const auto unit = fields.find("unit")) {
    context_.metres_per_unit = *metres_per(length_units()[unit->choice(length_units())]);
  }
  if (const auto materials = fields.find("materials")) {
    for (const auto& [name, value] : materials->entries()) read_material(name, value);
  }
  if (const auto lights = fields.find("lights")) {
    for (const Value& light : lights->items()) {
      sources_.push_back(read_source(light.labelled("light"), sources_.size() + 1));
    }
  }
  if (const auto cameras = fields.find("cameras")) {
    for (const auto& [name, value] : cameras->entries()) {
      cameras_.push_back(read_camera(name, value));
    }
  }
}

void SideFile::read_material(const Value& name, const Value& value) {
  const Fields fields(value, {"color", "reflectance", "emission"});
  Color color;
  if (const auto given = fields.find("color")) color = read_color(*given);
  for (const auto& [known, emission] : looks_) {
    if (known == color) {
      name.fail(fmt::format("a second material for {}: one is enough",
                            color ? "the color " + color_name(color) : "what has no 'color'"));
    }
  }
  const std::optional<Value> reflectance = fields.find("reflectance");
  materials_.push_back(
      {name.text(), reflectance ? read_reflectance(*reflectance) : reflectance_of(color)});
  looks_.emplace_back(color, fields.find("emission"));
}

std::uint32_t SideFile::material(const Color& color) {
  const auto found = std::find_if(looks_.begin(), looks_.end(),
                                  [&](const auto& look) { return look.first == color; });
  if (found != looks_.end()) return static_cast<std::uint32_t>(found - looks_.begin());
  materials_.push_back({color_name(color), reflectance_of(color)});
  looks_.emplace_back(color, std::nullopt);
  return static_cast<std::uint32_t>(looks_.size() - 1);
}

Rgb SideFile::exitance(std::uint32_t material, const Shape& shape) const {
  const std::optional<Value>& emission = looks_[material].second;
  return emission ? read_emission(*emission, shape) : Rgb{};
}

}  // namespace isolux::openscad
