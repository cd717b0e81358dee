#include "isolux/image/png.h"

#include <fmt/format.h>
#include <png.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "isolux/core/error.h"
#include "isolux/core/file.h"

namespace isolux {

int srgb_code(double linear) {
  if (!(linear > 0)) return 0;
  const double v = std::min(linear, 1.0);
  const double coded = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
  return static_cast<int>(std::lround(255 * coded));
}

void write_png(const Picture& display, const std::filesystem::path& path) {
  if (display.pixels.empty()) throw InputError({path.string()}, "the picture has no pixels");
  std::vector<std::uint8_t> codes;
  codes.reserve(3 * display.pixels.size());
  for (const Rgb& c : display.pixels) {
    for (double v : {c.r, c.g, c.b}) codes.push_back(static_cast<std::uint8_t>(srgb_code(v)));
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(display.width);
  image.height = static_cast<png_uint_32>(display.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, codes.data(), 0, nullptr)) {
    throw InputError({path.string()}, fmt::format("can't be encoded: {}", image.message));
  }
  bytes.resize(size);
  write_file(path, bytes);
}

}  // namespace isolux
