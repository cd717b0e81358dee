#pragma once

#include <cstddef>
#include <vector>

#include "isolux/core/color.h"

namespace isolux {

/// A picture of width × height pixels, row by row from the top left. What a pixel measures is for
/// its maker to say.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<Rgb> pixels;

  Picture() = default;
  Picture(int w, int h)
      : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  Rgb& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgb& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

}  // namespace isolux
