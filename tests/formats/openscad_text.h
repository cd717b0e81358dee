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

/// A folder of this process's own for models.
inline std::filesystem::path model_folder() {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("isolux-openscad-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

/// Writes the model, and its lights where there are some.
inline std::filesystem::path write_model(const std::string& text, const std::string& lights = {}) {
  const auto path = model_folder() / "test.csg", beside = model_folder() / "test.lights.yaml";
  write_file(path, text);
  std::filesystem::remove(beside);
  if (!lights.empty()) write_file(beside, lights);
  return path;
}

inline SceneFile read_model(const std::string& text, const std::string& lights = {}) {
  return load_scene_file(write_model(text, lights));
}

/// The shape of the first object; a unit is a metre.
inline std::shared_ptr<const Shape> model_shape(const std::string& text) {
  return read_model(text, "unit: m\n").scene.objects.at(0).shape;
}

/// What reading is refused with, without the folder ("test.csg:12:3: ..."); empty where it is not.
inline std::string model_refusal(const std::string& text, const std::string& lights = {}) {
  const auto path = write_model(text, lights);
  try {
    load_scene_file(path);
  } catch (const InputError& error) {
    const std::string message = error.what(), folder = model_folder().string() + '/';
    return message.starts_with(folder) ? message.substr(folder.size()) : message;
  }
  return {};
}

/// The volume that a fine grid of lines finds in the shape, to about 1e-3 of it.
inline double volume_of(const Shape& shape) {
  constexpr int kLines = 400;
  const Bounds box = shape.bounds();
  const Vec3 size = box.upper - box.lower;
  double sum = 0;
  Hits hits;
  for (int i = 0; i < kLines * kLines; ++i) {
    const double u = (i % kLines + 0.5) / kLines, v = (i / kLines + 0.5) / kLines;
    hits.clear();
    shape.intersect({box.lower + Vec3{u * size.x, v * size.y, -1}, {0.0, 0.0, 1.0}}, hits);
    for (std::size_t k = 0; k + 1 < hits.size(); k += 2) sum += hits[k + 1].t - hits[k].t;
  }
  return sum * size.x * size.y / (kLines * kLines);
}

}  // namespace isolux
