#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "isolux/formats/rayshade/place.h"

namespace isolux::rayshade {

/// A scene's text with its includes, its macros expanded and its comments gone, and the places that
/// the pieces of it come from.
struct SourceText {
  struct Piece {
    std::size_t begin = 0;  ///< in `text`
    Place place;            ///< of its first character
    bool runs = true;       ///< else all of it is at that place, that of a macro
  };

  std::string text;
  std::vector<Piece> pieces;
  std::deque<std::string> files;  ///< the scene's own first
};

/// Reads a scene through the directives of the C preprocessor: define, undef, include, ifdef,
/// ifndef, if (of 0 or 1), else, endif.
SourceText preprocess(const std::filesystem::path& scene);

}  // namespace isolux::rayshade
