#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "formats/has_note.h"
#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/formats/scene_file.h"

namespace isolux {

/// A folder of this process's own for scenes.
inline std::filesystem::path scene_folder() {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("isolux-rayshade-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::filesystem::path write_scene(const std::string& text,
                                         const std::string& name = "test.ray") {
  const auto path = scene_folder() / name;
  write_file(path, text);
  return path;
}

inline SceneFile read_rayshade_text(const std::string& text) {
  return load_scene_file(write_scene(text));
}

inline Scene rayshade_scene(const std::string& text) { return read_rayshade_text(text).scene; }

/// The shape of the first object.
inline std::shared_ptr<const Shape> rayshade_shape(const std::string& text) {
  return rayshade_scene(text).objects.at(0).shape;
}

/// What reading the text is refused with, from its line on ("12:3: ..."); empty where it is not.
inline std::string rayshade_refusal(const std::string& text) {
  const auto path = write_scene(text);
  try {
    load_scene_file(path);
  } catch (const InputError& error) {
    const std::string message = error.what(), file = path.string() + ':';
    return message.starts_with(file) ? message.substr(file.size()) : message;
  }
  return {};
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_LT(distance(a, b), tolerance) << '(' << a.x << ", " << a.y << ", " << a.z << ") against ("
                                       << b.x << ", " << b.y << ", " << b.z << ')';
}

}  // namespace isolux
