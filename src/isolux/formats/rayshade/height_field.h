#pragma once

#include <string>

#include "isolux/geometry/shape.h"

namespace isolux::rayshade {

/// The triangles of a height field over the unit square: a file of a 32-bit count n and n × n
/// 32-bit floating-point heights, row by row along y, little or big end first. Heights of −1000 or
/// less stand for places that are not there. Throws InputError without a place.
TriangleSoup height_field(const std::string& bytes);

}  // namespace isolux::rayshade
