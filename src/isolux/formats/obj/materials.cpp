#include "isolux/formats/obj/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <optional>

#include "isolux/core/error.h"
#include "isolux/formats/colorimetry.h"
#include "isolux/formats/statement_reader.h"
#include "isolux/formats/texture.h"

namespace isolux::obj {
namespace {

/// The colour of a line such as "Kd r [g b]"; nothing for spectra and CIE XYZ.
std::optional<Rgb> read_color(const Statement& s) {
  s.expect_arguments(1, 4, std::string(s.word(0)) + " r g b");
  if (s.word(1) == "spectral" || s.word(1) == "xyz") return std::nullopt;
  if (s.size() == 2) return gray(s.number_of_at_least_0(1));
  s.expect_arguments(3, 3, std::string(s.word(0)) + " r g b");
  return Rgb{s.number_of_at_least_0(1), s.number_of_at_least_0(2), s.number_of_at_least_0(3)};
}

std::optional<Rgb> read_texture(const Statement& s, const std::string& folder, Includes& includes,
                                Textures& textures) {
  s.expect_arguments(1, Statement::kAnyNumber, "map_Kd file");
  std::string name(s.word(s.size() - 1));
  std::replace(name.begin(), name.end(), '\\', '/');
  return textures.mean_color_of(name, includes, folder);
}

}  // namespace

void read_materials(const SourceText& source, Includes& includes, Textures& textures,
                    Materials& materials, Notes& notes) {
  StatementReader statements(source);
  Look unnamed;
  Look* look = &unnamed;
  Rgb color = gray(1), texture = gray(1);
  const auto finish = [&] { look->reflectance = color * texture; };
  while (const auto s = statements.next()) {
    const std::string_view word = s->word(0);
    if (word == "newmtl") {
      s->expect_arguments(1, 1, "newmtl name");
      finish();
      const std::string name(s->word(1));
      const auto [place, is_new] = materials.try_emplace(name);
      look = is_new ? &place->second : &unnamed;
      look->material = name;
      look->two_sided = true;
      color = gray(0.5), texture = gray(1);
    } else if (word == "Kd" || word == "Ke") {
      const auto value = read_color(*s);
      if (!value) {
        notes.add(fmt::format("{} as a spectrum or in CIE XYZ: left out", word));
      } else if (word == "Kd") {
        color = *value;
      } else {
        look->exitance = luminance_of_radiance(*value) * std::numbers::pi;
      }
    } else if (word == "map_Kd") {
      if (const auto mean = read_texture(*s, source.file, includes, textures)) {
        texture = *mean;
        notes.add("textures: their mean color alone is kept");
      } else {
        notes.add("textures that can't be read as PNG or JPEG: left out");
      }
    } else if (word == "map_Ke") {
      notes.left_out("map_Ke", "lights shine evenly");
    } else if (word == "Ks" || word == "map_Ks") {
      if (word == "map_Ks" || read_color(*s).value_or(Rgb{}) != Rgb{}) {
        notes.left_out("Ks", "surfaces are diffuse");
      }
    } else if (word == "d" || word == "Tr") {
      s->expect_arguments(1, 2, std::string(word) + " fraction");
      if (s->number(s->size() - 1) != (word == "d" ? 1 : 0)) {
        notes.left_out(word == "d" ? "d" : "Tr", "surfaces are opaque");
      }
    } else if (word == "map_d") {
      notes.left_out("map_d", "surfaces are opaque");
    }
  }
  finish();
}

}  // namespace isolux::obj
