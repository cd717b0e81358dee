#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "isolux/scene/reader.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// A scene given in the native format, without its first line.
inline Scene scene_of(const std::string& yaml) { return read_scene("isolux: 1\n" + yaml, "test"); }

inline std::filesystem::path source_dir() { return ISOLUX_SOURCE_DIR; }

/// The scene of the paper.
inline Scene paper_room() { return load_scene(source_dir() / "examples/lalonde1993/room.yaml"); }

/// Validation data that is kept beside the project, not in it.
inline std::filesystem::path shared_dir() { return source_dir().parent_path() / "shared"; }

/// Skips the test where that data is absent, but fails it in continuous integration.
#define ISOLUX_NEED_SHARED()                                                          \
  if (!std::filesystem::exists(shared_dir() / "validation")) {                        \
    const char* ci = std::getenv("CI");                                               \
    if (ci && std::string(ci) == "true") FAIL() << "no validation data in ../shared"; \
    GTEST_SKIP() << "no validation data in ../shared";                                \
  }

/// Skips the test where the scenes kept beside the project are absent, but fails it in continuous
/// integration.
#define ISOLUX_NEED_SCENES()                                                 \
  if (!std::filesystem::exists(shared_dir() / "scenes")) {                   \
    const char* ci = std::getenv("CI");                                      \
    if (ci && std::string(ci) == "true") FAIL() << "no scenes in ../shared"; \
    GTEST_SKIP() << "no scenes in ../shared";                                \
  }

}  // namespace isolux
