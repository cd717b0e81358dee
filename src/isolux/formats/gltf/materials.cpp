#include "isolux/formats/gltf/materials.h"

#include <fmt/format.h>

#include <numbers>

namespace isolux::gltf {

Rgb Materials::mean(const Json& texture_info) {
  const Json texture = document_.item("textures", texture_info.require("index"));
  if (const auto source = texture.find("source")) {
    const std::size_t number = document_.number("images", *source);
    const Json image = document_.item("images", *source);
    const auto mean =
        textures_.mean_color(std::to_string(number), [&] { return document_.image(image); });
    if (mean) {
      notes_.add("textures: their mean color alone is kept");
      return *mean;
    }
  }
  notes_.add("textures that can't be read as PNG or JPEG: left out");
  return gray(1);
}

Rgb Materials::color(const Json& owner, const char* factor, const char* texture,
                     const Rgb& otherwise) {
  Rgb color = otherwise;
  if (const auto list = owner.find(factor)) {
    const std::vector<double> v = list->numbers(list->size() == 4 ? 4 : 3);
    color = {v[0], v[1], v[2]};
    if (!(min_channel(color) >= 0)) list->fail("must not be negative");
  }
  const auto info = owner.find(texture);
  return info && max_channel(color) > 0 ? color * mean(*info) : color;
}

void Materials::note_what_is_left_out(const Json& material) {
  const std::string alpha = material.text("alphaMode");
  if (!alpha.empty() && alpha != "OPAQUE") {
    notes_.left_out("alphaMode", "surfaces are opaque");
  }
  if (material.extension("KHR_materials_transmission")) {
    notes_.left_out("KHR_materials_transmission", "surfaces are opaque");
  }
  const auto pbr = material.find("pbrMetallicRoughness");
  if (!pbr || pbr->number("metallicFactor", 1) > 0) {
    notes_.add("metals: taken as diffuse, with their base color as reflectance");
  }
}

Look Materials::read(const Json& material) {
  Look look;
  look.material = material.text("name");
  look.two_sided = material.flag("doubleSided");
  look.reflectance = gray(1);
  if (const auto glossy = material.extension("KHR_materials_pbrSpecularGlossiness")) {
    look.reflectance = color(*glossy, "diffuseFactor", "diffuseTexture", gray(1));
  } else if (const auto pbr = material.find("pbrMetallicRoughness")) {
    look.reflectance = color(*pbr, "baseColorFactor", "baseColorTexture", gray(1));
  }
  // cd/m², times π for a diffuse surface.
  look.exitance = color(material, "emissiveFactor", "emissiveTexture", {}) * std::numbers::pi;
  if (const auto strength = material.extension("KHR_materials_emissive_strength")) {
    const double factor = strength->number("emissiveStrength", 1);
    if (!(factor >= 0)) strength->fail("must not be negative");
    look.exitance *= factor;
  }
  note_what_is_left_out(material);
  return look;
}

const Look& Materials::of(const Json& primitive) {
  const auto index = primitive.find("material");
  if (!index) return default_;
  const std::size_t number = document_.number("materials", *index);
  const auto [look, is_new] = looks_.try_emplace(number);
  if (is_new) look->second = read(document_.item("materials", *index));
  return look->second;
}

}  // namespace isolux::gltf
