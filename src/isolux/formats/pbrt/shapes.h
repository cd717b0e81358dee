#pragma once

#include "isolux/formats/assembly.h"
#include "isolux/formats/pbrt/parameters.h"

namespace isolux::pbrt {

/// A Shape directive's surface, placed by `map`, turned over where `reversed`; null where it is of
/// no known kind (which is noted) or has no area. With `two_sided`, its winding is of no interest.
/// Files of meshes are read by `includes`; `where` is the place of the directive.
std::shared_ptr<const Shape> make_shape(std::string_view kind, const Parameters& parameters,
                                        const Affine& map, bool reversed, bool two_sided,
                                        const SourceLocation& where, Includes& includes,
                                        Assembly& assembly);

}  // namespace isolux::pbrt
