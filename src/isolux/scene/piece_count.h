#pragma once

#include <fmt/format.h>

#include <cstddef>

#include "isolux/core/error.h"

namespace isolux {

/// Counts the pieces of all curved patches of a scene, each of which takes about 1 KB.
class PieceCount {
 public:
  /// Throws InputError where there are too many.
  void add(std::size_t pieces) {
    constexpr std::size_t kMost = 400'000;
    pieces_ += pieces;
    if (pieces_ <= kMost) return;
    throw InputError(fmt::format(
        "the scene has more than {} pieces of curved patches: give it fewer patches", kMost));
  }

 private:
  std::size_t pieces_ = 0;
};

}  // namespace isolux
