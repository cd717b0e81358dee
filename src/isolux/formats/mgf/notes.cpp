#include "isolux/formats/mgf/notes.h"

#include <fmt/format.h>

#include "isolux/scene/spelling.h"

namespace isolux::mgf {

std::vector<std::string> notes_of(const Findings& found) {
  constexpr std::size_t kMostUnknown = 20;
  std::vector<std::string> notes;
  const auto note = [&](std::size_t count, std::string_view noun, std::string_view what) {
    if (count == 0) return;
    notes.push_back(fmt::format("{} {}{}: {}", count, noun, count == 1 ? "" : "s", what));
  };
  note(found.specular, "material",
       "specular reflectance (rs) is absorbed; the diffuse reflectance (rd) alone is kept");
  note(found.transmitting, "material",
       "transmittance (td, ts) is absorbed; the surfaces are opaque");
  note(found.refracting, "material", "the index of refraction (ir) is ignored");
  note(found.clamped, "material", "diffuse reflectance (rd) of 1 or more is reduced to 0.999");
  note(
      found.paled, "material",
      "the colour is more saturated, or brighter, than Rec. 709 can tell; it is mixed with grey of "
      "the same luminance");
  note(found.two_sided_lights, "light",
       "emits (ed) from both sides (sides 2); light leaves the front alone, the back is black");
  note(found.dark_lights, "light", "a torus can't emit (ed); it is dark");
  note(found.empty, "surface", "has no area; it is left out");
  note(found.folded, "face", "its corners don't lie in a plane; it is cut into flat triangles");
  note(found.smoothed, "face", "has vertex normals (n); it stays flat");
  note(found.dark_spectra, "color",
       "the spectrum (cspec) has no luminance; it is taken as neutral");
  note(found.luminaires, "luminaire", "ies files are not read; its light is missing");
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
