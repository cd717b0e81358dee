#pragma once

#include "isolux/core/affine.h"
#include "isolux/formats/gltf/json.h"
#include "isolux/scene/scene.h"

namespace isolux::gltf {

/// A node's map to its parent. Throws InputError where it can't be inverted.
Affine map_of(const Json& node);

/// A light of KHR_lights_punctual at a node that has this map.
Source source_of(const Json& light, const Affine& map);

/// A perspective camera at such a node; nothing for others.
std::optional<Camera> camera_of(const Json& camera, const Affine& map);

}  // namespace isolux::gltf
