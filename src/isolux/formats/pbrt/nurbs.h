#pragma once

#include "isolux/formats/assembly.h"
#include "isolux/formats/pbrt/parameters.h"

namespace isolux::pbrt {

/// The "nurbs" of version 3, whole, in its own frame; null where a degree is above 3. `where` is
/// the place of the directive.
std::shared_ptr<const Shape> make_nurbs(const Parameters& parameters, const SourceLocation& where,
                                        Assembly& assembly);

}  // namespace isolux::pbrt
