#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "isolux/core/error.h"
#include "isolux/formats/notes.h"
#include "isolux/formats/radiance/sky_pattern.h"

namespace isolux::radiance {

/// The patterns that the light of a source goes through.
struct LightPattern {
  std::shared_ptr<const SkyPattern> sky;  ///< where it is one sky
  bool other = false;                     ///< where it is something else
};

/// The light of a source.
struct SourceLight {
  Rgb luminance;  ///< cd/m², before the pattern
  LightPattern pattern;
};

/// The sources of a scene that are half or all that surrounds it, and the sky that they make.
class Skies {
 public:
  explicit Skies(Notes& notes) : notes_(notes) {}

  /// `toward` is the middle of the source, `angle` its width in degrees, `place` where it is
  /// written. Notes sources of other widths, and leaves them out. Throws InputError with the place
  /// where there are too many.
  void add(const Vec3& toward, double angle, const SourceLight& light, const SourceLocation& place);

  /// The sky, where there is one that shines; notes what is left out. Throws InputError with the
  /// place where it is too bright.
  std::optional<Sky> sky() const;

 private:
  struct Source {
    Vec3 toward;
    bool whole;  ///< all around, else a hemisphere
    SourceLight light;
    SourceLocation place;
  };

  /// The zenith by the first source with a sky as its pattern; else by the first of all.
  Vec3 up() const;
  /// What the source alone would make; uniform, about +z, without a pattern. Nothing, and a note,
  /// where that can't be.
  std::optional<Sky> sky_of(const Source& source) const;

  Notes& notes_;
  std::vector<Source> sources_;
};

}  // namespace isolux::radiance
