#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace isolux::mgf {

/// How often a scene asks for what diffuse surfaces can't give. Materials count where surfaces have
/// them.
struct Findings {
  std::size_t specular = 0, transmitting = 0, refracting = 0;  ///< materials
  std::size_t clamped = 0, paled = 0;                          ///< materials
  std::size_t two_sided_lights = 0, empty = 0;                 ///< surfaces
  std::size_t folded = 0, smoothed = 0;                        ///< faces
  std::size_t dark_spectra = 0;                                ///< colors
  std::size_t luminaires = 0;                                  ///< ies
  std::set<std::string> unknown;                               ///< keywords
};

/// One line for each kind, with what was done instead.
std::vector<std::string> notes_of(const Findings& findings);

}  // namespace isolux::mgf
