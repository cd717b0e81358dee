#pragma once

#include "isolux/scene/make_shape.h"

namespace isolux {

// Readers of the shapes that are given by lists of points, each from what stands under its key.

ShapePtr read_polygon(const Value& value);
ShapePtr read_mesh(const Value& value);
ShapePtr read_prism(const Value& value);
ShapePtr read_revolution(const Value& value);
ShapePtr read_sweep(const Value& value);
ShapePtr read_height_field(const Value& value);
ShapePtr read_bezier(const Value& value);
ShapePtr read_nurbs(const Value& value);

}  // namespace isolux
