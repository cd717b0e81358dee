#include "isolux/formats/mgf/notes.h"

#include <fmt/format.h>

#include "isolux/scene/spelling.h"

namespace isolux::mgf {

std::vector<std::string> notes_of(const Findings& found) {
  constexpr std::size_t kMostUnknown = 20;
  std::vector<std::string> notes;
  const auto note = [&](std::string_view before, std::size_t count, std::string_view noun,
                        std::string_view after) {
    if (count == 0) return;
    notes.push_back(fmt::format("{}{} {}{}{}", before, count, noun, count == 1 ? "" : "s", after));
  };
  note("specular reflectance (rs) of ", found.specular, "material",
       ": absorbed, only the diffuse reflectance (rd) is kept");
  note("transmittance (td, ts) of ", found.transmitting, "material",
       ": absorbed, nothing shines through");
  note("index of refraction (ir) of ", found.refracting, "material", ": ignored");
  note("diffuse reflectance (rd) of 1 or more, of ", found.clamped, "material",
       ": reduced to 0.999");
  note("colour beyond the range of Rec. 709, of ", found.paled, "material",
       ": mixed with grey of the same luminance");
  note("emission (ed) from both sides of ", found.two_sided_lights, "light",
       ": from the front alone, the back is black");
  note("emission (ed) of a torus, ", found.dark_lights, "light", ": left out, it is dark");
  note("", found.empty, "surface", " without area: left out");
  note("", found.folded, "face", " with corners off the plane: cut into flat triangles");
  note("", found.smoothed, "face", " with vertex normals (n): kept flat");
  note("spectrum (cspec) without luminance, ", found.dark_spectra, "colour", ": taken as neutral");
  note("", found.luminaires, "luminaire", " in IES files (ies): not read, the light is missing");
  std::size_t named = 0;
  for (const std::string& keyword : found.unknown) {
    if (named++ == kMostUnknown) {
      notes.push_back(fmt::format("and {} more unknown entities: ignored",
                                  found.unknown.size() - kMostUnknown));
      break;
    }
    notes.push_back(fmt::format("unknown entity {}: ignored", in_quotes(keyword)));
  }
  return notes;
}

}  // namespace isolux::mgf
