#pragma once

#include <memory>
#include <string>

#include "isolux/geometry/shape.h"

namespace isolux::rayshade {

/// A height field over the unit square: a file of a 32-bit count n and n × n 32-bit floating-point
/// heights, row by row along y, little or big end first. Heights of −1000 or less stand for places
/// that are not there; a field with such places is a mesh. Throws InputError without a place.
std::shared_ptr<const Shape> height_field(const std::string& bytes);

}  // namespace isolux::rayshade
