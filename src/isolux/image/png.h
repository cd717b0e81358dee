#pragma once

#include <filesystem>

#include "isolux/image/picture.h"

namespace isolux {

/// The 8-bit code of a linear display value: clamped to [0, 1], then the sRGB curve of
/// IEC 61966-2-1. NaN gives 0.
int srgb_code(double linear);

/// Writes a picture of linear display values, 0 black to 1 white, as an 8-bit sRGB PNG; whole or
/// not at all. Throws InputError where the picture is empty or the file can't be written.
void write_png(const Picture& display, const std::filesystem::path& path);

}  // namespace isolux
