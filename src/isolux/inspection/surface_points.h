#pragma once

#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

/// Points of each object's surface, by object: where random lines through the boxes of its parts
/// meet it, 64 of them however large it is (down to 16 where objects are very many). They are not
/// spread evenly by area; `t` is of no use. Empty where very many lines find nothing.
/// Deterministic. Cost: linear in the objects.
std::vector<std::vector<Hit>> points_on_objects(const Scene& scene);

}  // namespace isolux
