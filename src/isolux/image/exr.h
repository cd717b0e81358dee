#pragma once

#include <filesystem>

#include "isolux/image/picture.h"

namespace isolux {

/// Writes a picture of luminances (cd/m²) as OpenEXR: scanlines of 32-bit float R, G, B with
/// Rec. 709 primaries, ZIP, and the attribute whiteLuminance = 1 cd/m². Whole or not at all.
/// Throws InputError where the picture is empty or the file can't be written.
void write_exr(const Picture& luminance, const std::filesystem::path& path);

}  // namespace isolux
