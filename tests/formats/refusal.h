#pragma once

#include <gmock/gmock.h>

#include <string>

#include "formats/temporary_folder.h"
#include "isolux/core/error.h"
#include "isolux/core/random.h"
#include "isolux/formats/scene_file.h"

namespace isolux {

/// A scene read from such a file.
inline SceneFile scene_in(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  return load_scene_file(folder.write(name, text));
}

/// What reading such a file is refused with, without its folder; empty where it is not.
inline std::string refusal_of(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  try {
    load_scene_file(folder.write(name, text));
  } catch (const InputError& error) {
    const std::string message = error.what(), path = folder.path().string() + '/';
    return message.starts_with(path) ? message.substr(path.size()) : message;
  }
  return {};
}

/// Reads `count` damaged copies of a file: each is a scene, or refused in one line.
inline void expect_no_harm(const std::string& name, const std::string& text, int count) {
  const TemporaryFolder folder;
  Random random(1);
  for (int i = 0; i < count; ++i) {
    std::string damaged = text;
    for (std::size_t edits = 1 + random.below(4); edits > 0 && !damaged.empty(); --edits) {
      const std::size_t at = random.below(damaged.size());
      switch (random.below(5)) {
        case 0:
          damaged[at] = static_cast<char>(random.below(256));
          break;
        case 1:
          damaged.resize(at);
          break;
        case 2:
          damaged.insert(at, 1 + random.below(9), "0123456789-.eE{}[]\""[random.below(19)]);
          break;
        case 3:
          damaged.erase(at, 1 + random.below(9));
          break;
        default:
          damaged.insert(at, damaged.substr(random.below(damaged.size()), random.below(40)));
      }
    }
    // File systems write a file that is cut short and filled again to the disk at once.
    std::filesystem::remove(folder.path() / name);
    try {
      load_scene_file(folder.write(name, damaged));
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
      EXPECT_LT(std::string(error.what()).size(), 600u);
    }
  }
}

}  // namespace isolux
