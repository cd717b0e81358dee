#pragma once

#include <optional>
#include <string>

#include "isolux/formats/include_path.h"
#include "isolux/formats/statement.h"
#include "isolux/scene/scene.h"

namespace isolux::radiance {

/// A view as the options of Radiance's renderers give it.
struct View {
  std::string name;
  char type = 'v';  ///< v for perspective
  Vec3 eye;
  Vec3 direction{0, 1, 0};
  Vec3 up{0, 0, 1};
  double width = 45, height = 45;  ///< of the picture, degrees
  bool shifted = false;            ///< the picture's middle is not where the eye looks
};

/// Takes the options from word `first` on, leaving what concerns no view aside. Throws InputError
/// with the place where one lacks its numbers.
void read_view(const Statement& options, std::size_t first, Includes& includes, View& view);

/// The view of a file: the last line that is one, a program and its options or "VIEW= options".
/// Nothing where there is none.
std::optional<View> view_of_file(const SourceText& source, Includes& includes);

/// The camera that sees the same; nothing where that is not a perspective.
std::optional<Camera> camera_of(const View& view);

}  // namespace isolux::radiance
