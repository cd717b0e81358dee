#pragma once

#include "isolux/formats/include_path.h"
#include "isolux/formats/soup.h"

namespace isolux {

/// The polygons of a PLY file (Turk 1994), as text or binary in either order of bytes; of its
/// elements, the x, y, z of `vertex` and the `vertex_indices` (or `vertex_index`) of `face`. Throws
/// InputError, with line and column but for the binary part.
TriangleSoup parse_ply(const SourceText& source, Cutting& cutting);

}  // namespace isolux
