#pragma once

#include <vector>

#include "isolux/formats/include_path.h"
#include "isolux/formats/notes.h"
#include "isolux/formats/radiance/surfaces.h"

namespace isolux::radiance {

/// What generators know of the scene around them.
struct Surroundings {
  Includes& includes;
  Notes& notes;
  double effort = 0;  ///< steps that all expressions of the scene took
};

// What Radiance's generator programs make of their arguments, word 0 being the program and word 1
// the modifier of all surfaces. They throw InputError (with a place where a word is to blame) and
// Unsupported where an argument asks for what is not read here.

/// genbox mod name x y z [-i] [-b bevel | -r radius]: round edges stay round.
std::vector<Surface> generate_box(const Statement& s, Surroundings& around);
/// genprism mod name (file | N x1 y1 ... xN yN) [-l dx dy dz] [-r radius] [-c] [-e]
std::vector<Surface> generate_prism(const Statement& s, Surroundings& around);
/// genblinds mod name depth width height slats angle [-r radius | +r radius]
std::vector<Surface> generate_blinds(const Statement& s, Surroundings& around);

// Those that take expressions.

/// genrev mod name z(t) r(t) segments [-s]: exact cones, cylinders and rings.
std::vector<Surface> generate_revolution(const Statement& s, Surroundings& around);
/// genworm mod name x(t) y(t) z(t) r(t) segments: exact cones joined by spheres.
std::vector<Surface> generate_worm(const Statement& s, Surroundings& around);
/// gensurf mod name x(s,t) y(s,t) z(s,t) m n [-s] [-i]: one mesh.
std::vector<Surface> generate_surface(const Statement& s, Surroundings& around);

}  // namespace isolux::radiance
