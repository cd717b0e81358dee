#pragma once

#include <optional>

#include "isolux/core/affine.h"
#include "isolux/core/color.h"
#include "isolux/formats/mitsuba/document.h"

namespace isolux::mitsuba {

// The parameters of an object are its children that have a name. What is asked for and of another
// kind is an error.

/// The parameter of that name; null where it is not there.
const Element* find(const Element& object, std::string_view name);
double number(const Element& object, std::string_view name, double otherwise);
bool flag(const Element& object, std::string_view name);
/// The text of a <string>; empty where it is not there.
std::string_view text(const Element& object, std::string_view name);
/// A <point> or <vector>.
Vec3 vector(const Element& object, std::string_view name, const Vec3& otherwise);
/// The <transform> of that name: its steps, the first one first. Has an inverse.
Affine transform(const Element& object, std::string_view name);

/// The finite numbers of an attribute, between blanks or commas.
std::vector<double> numbers(const Element& element, std::string_view attribute);

/// What a <float>, <rgb>, <srgb> or <spectrum> says, not negative: linear Rec. 709, a
/// spectrum of 1 everywhere being (1, 1, 1). Nothing for spectra in files and of unknown types.
std::optional<Rgb> plain_color(const Element& element);

}  // namespace isolux::mitsuba
