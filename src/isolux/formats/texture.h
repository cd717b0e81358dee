#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <unordered_map>

#include "isolux/core/color.h"
#include "isolux/formats/include_path.h"
#include "isolux/formats/notes.h"

namespace isolux {

/// A value of the sRGB transfer curve (IEC 61966-2-1), 0 to 1, made linear.
double linear_of_srgb(double value);

/// Mean colours of textures.
class Textures {
 public:
  /// The mean of all texels of a PNG or JPEG file, linear; nothing where the bytes are no such
  /// file, or a picture of more than 64 million texels, or all textures have more than 256 million.
  /// `key` stands for the file: `bytes` is asked once a key.
  std::optional<Rgb> mean_color(const std::string& key, const std::function<std::string()>& bytes);
  /// That of a file of the scene; nothing where it can't be opened either. `folder` tells apart
  /// files of one name that are included from different folders.
  std::optional<Rgb> mean_color_of(const std::string& file, Includes& includes,
                                   const std::string& folder = {});
  /// Gray of 0.5 where there is none. Notes what was done.
  Rgb mean_color_of(const std::string& file, Includes& includes, Notes& notes);

 private:
  std::optional<Rgb> mean_color(const std::string& image);

  std::unordered_map<std::string, std::optional<Rgb>> known_;
  std::int64_t texels_left_ = 256'000'000;
};

}  // namespace isolux
