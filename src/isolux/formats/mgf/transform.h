#pragma once

#include <vector>

#include "isolux/core/affine.h"
#include "isolux/formats/mgf/statement.h"

namespace isolux::mgf {

/// Reads a transform, the words from `first` on: the maps of its instances, one but for arrays, at
/// most `most`. All are finite and none flattens.
std::vector<Affine> read_transform(const Statement& s, std::size_t first, std::size_t most);

}  // namespace isolux::mgf
