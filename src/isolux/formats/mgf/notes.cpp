#include "isolux/formats/mgf/notes.h"

#include <fmt/format.h>

#include "isolux/formats/limits.h"
#include "isolux/formats/notes.h"
#include "isolux/scene/spelling.h"

namespace isolux::mgf {

std::vector<std::string> notes_of(const Findings& found) {
  constexpr std::size_t kMostUnknown = 20;
  Notes notes;
  notes.add(found.specular, "material",
            "with specular reflectance (rs): absorbed, only the diffuse reflectance (rd) is kept");
  notes.add(found.transmitting, "material",
            "with transmittance (td, ts): absorbed, nothing shines through");
  notes.add(found.refracting, "material", "with an index of refraction (ir): ignored");
  notes.add(
      found.clamped, "material",
      fmt::format("with a diffuse reflectance (rd) of 1 or more: reduced to {}", kMostReflectance));
  notes.add(found.paled, "material",
            "with a colour beyond the range of Rec. 709: mixed with grey of the same luminance");
  notes.add(found.two_sided_lights, "light",
            "with emission (ed) from both sides: from the front alone, the back is black");
  notes.add(found.empty, "surface", "without area: left out");
  notes.add(found.folded, "face", "with corners off the plane: cut into flat triangles");
  notes.add(found.smoothed, "face", "with vertex normals (n): kept flat");
  notes.add(found.dark_spectra, "colour",
            "with a spectrum (cspec) without luminance: taken as neutral");
  notes.add(found.luminaires, "luminaire", "in IES files (ies): not read, the light is missing");
  std::size_t named = 0;
  for (const std::string& keyword : found.unknown) {
    if (named++ == kMostUnknown) {
      notes.add(fmt::format("and {} more unknown entities: ignored",
                            found.unknown.size() - kMostUnknown));
      break;
    }
    notes.add(fmt::format("unknown entity {}: ignored", in_quotes(keyword)));
  }
  return notes.lines();
}

}  // namespace isolux::mgf
