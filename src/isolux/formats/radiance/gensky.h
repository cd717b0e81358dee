#pragma once

#include <string>

#include "isolux/formats/notes.h"
#include "isolux/formats/statement.h"

namespace isolux::radiance {

/// What Radiance's program gensky writes for these arguments (gensky(1)), word 0 being its name: a
/// source `sun` half a degree wide where there is one, and a pattern `skyfunc`. East is x, north
/// y. Throws InputError with the place where an argument is wrong, and Unsupported where it is not
/// known.
std::string generate_sky(const Statement& s, Notes& notes);

}  // namespace isolux::radiance
