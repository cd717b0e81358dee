#pragma once

#include <vector>

#include "isolux/core/affine.h"
#include "isolux/formats/statement.h"

namespace isolux {

/// Reads the steps of a transform (-t x y z, -rx degrees, -s factor, -mx, -i count, -a count ...)
/// from word `at` on, up to a word that is none, for it does not begin with '-'; `at` moves there.
/// Returns the maps of its instances, one but for arrays, at most `most`. All are finite and none
/// flattens.
std::vector<Affine> read_transform(const Statement& s, std::size_t& at, std::size_t most);

}  // namespace isolux
