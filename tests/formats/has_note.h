#pragma once

#include <string>

#include "isolux/formats/scene_file.h"

namespace isolux {

/// Whether one of the notes has that part.
inline bool has_note(const SceneFile& file, const std::string& part) {
  for (const std::string& note : file.notes) {
    if (note.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace isolux
