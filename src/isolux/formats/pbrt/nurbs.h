#pragma once

#include <memory>

#include "isolux/formats/notes.h"
#include "isolux/formats/pbrt/parameters.h"
#include "isolux/geometry/shape.h"

namespace isolux::pbrt {

/// The "nurbs" of version 3, whole, in its own frame; null where a degree is above 3. `where` is
/// the place of the directive.
std::shared_ptr<const Shape> make_nurbs(const Parameters& parameters, const SourceLocation& where,
                                        Notes& notes);

}  // namespace isolux::pbrt
