#pragma once

#include <gtest/gtest.h>

#include <string>

#include "isolux/core/error.h"
#include "isolux/scene/reader.h"

namespace isolux {

/// A scene of one object, from the lines that describe it (each indented by four spaces) and the
/// top-level lines before it.
inline std::string scene_text(const std::string& object, const std::string& top = "") {
  return "isolux: 1\n" + top +
         "materials: {gray: {reflectance: 0.5}}\n"
         "objects:\n"
         "  - material: gray\n" +
         object;
}

inline Object read_object(const std::string& object, const std::string& top = "") {
  return read_scene(scene_text(object, top), "test.yaml").objects.at(0);
}

/// What reading the text is refused with; empty where it is not.
inline std::string refusal(const std::string& text) {
  try {
    read_scene(text, "test.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_LT(distance(a, b), tolerance) << '(' << a.x << ", " << a.y << ", " << a.z << ") against ("
                                       << b.x << ", " << b.y << ", " << b.z << ')';
}

}  // namespace isolux
