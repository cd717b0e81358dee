#include "isolux/formats/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include "isolux/core/error.h"

namespace isolux {

double linear_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::optional<Rgb> Textures::mean_color(const std::string& key,
                                        const std::function<std::string()>& bytes) {
  const auto [place, is_new] = known_.try_emplace(key);
  if (is_new) place->second = mean_color(bytes());
  return place->second;
}

std::optional<Rgb> Textures::mean_color_of(const std::string& file, Includes& includes,
                                           const std::string& folder) {
  return mean_color(folder + '\n' + file, [&]() -> std::string {
    try {
      std::string bytes = includes.open(file).text;
      includes.close();
      return bytes;
    } catch (const InputError&) {
      return {};
    }
  });
}

Rgb Textures::mean_color_of(const std::string& file, Includes& includes, Notes& notes) {
  const auto found = mean_color_of(file, includes);
  notes.add(found ? "textures: their mean color alone is kept"
                  : "textures that can't be read as PNG or JPEG: gray of 0.5");
  return found.value_or(gray(0.5));
}

std::optional<Rgb> Textures::mean_color(const std::string& image) {
  constexpr std::int64_t kMostTexels = 64'000'000;
  if (image.empty() || image.size() > std::numeric_limits<int>::max()) return std::nullopt;
  const auto* const bytes = reinterpret_cast<const stbi_uc*>(image.data());
  const int size = static_cast<int>(image.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(bytes, size, &width, &height, &channels)) return std::nullopt;
  const std::int64_t texels = std::int64_t{width} * height;
  if (texels <= 0 || texels > std::min(kMostTexels, texels_left_)) return std::nullopt;
  texels_left_ -= texels;
  const std::unique_ptr<stbi_uc, void (*)(void*)> data(
      stbi_load_from_memory(bytes, size, &width, &height, &channels, 3), stbi_image_free);
  if (!data) return std::nullopt;
  std::array<std::array<std::int64_t, 256>, 3> counts{};
  for (std::int64_t i = 0; i < 3 * texels; ++i) ++counts[i % 3][data.get()[i]];
  std::array<double, 3> sums{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t value = 0; value < 256; ++value) {
      sums[channel] += static_cast<double>(counts[channel][value]) *
                       linear_of_srgb(static_cast<double>(value) / 255);
    }
  }
  return Rgb{sums[0], sums[1], sums[2]} / static_cast<double>(texels);
}

}  // namespace isolux
