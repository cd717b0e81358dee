#pragma once

#include "isolux/image/picture.h"
#include "isolux/image/supersample.h"
#include "isolux/solution/solution.h"

namespace isolux {

/// The mesh as a picture (Figure 3 c): dark lines along the sides of the triangles, those of lights
/// included, where the true surfaces show them; between them a lightened shading. Linear display
/// values, ready for write_png(). Throws InputError as supersample() does.
Picture mesh_picture(const Solution& solution, const Camera& camera,
                     const RenderOptions& options = {});

}  // namespace isolux
