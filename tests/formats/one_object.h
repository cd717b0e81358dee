#pragma once

#include <memory>
#include <string>
#include <utility>

#include "isolux/core/error.h"
#include "isolux/formats/written_scene.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// A scene with one grey object of that shape.
inline Scene one_object(std::shared_ptr<const Shape> shape) {
  Scene scene;
  scene.materials = {{"gray", gray(0.5)}};
  const Sides sides = shape->solid() ? Sides::front : Sides::both;
  scene.objects = {{"thing", std::move(shape), 0, sides, {}}};
  return scene;
}

/// What writing the scene is refused with; empty where it is not.
inline std::string refusal(WrittenScene (*write)(const Scene&), const Scene& scene) {
  try {
    write(scene);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace isolux
