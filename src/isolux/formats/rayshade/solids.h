#pragma once

#include <unordered_map>

#include "isolux/formats/notes.h"
#include "isolux/formats/rayshade/model.h"
#include "isolux/formats/rayshade/planes.h"

namespace isolux::rayshade {

/// Makes the solids that CSG joins, each but once however often it is mentioned.
///
/// Rayshade takes whatever a list holds for a closed surface. Here a cylinder or cone is closed by
/// caps, and discs of the same list that are its caps belong to it; triangles and polygons of a
/// list must together be watertight; what else a list holds is united; a plane is a half space.
class Solids {
 public:
  Solids(const PlaneCut& cut, Notes& notes) : cut_(cut), notes_(notes) {}

  /// The solid, its own map left aside; `map` is from its frame to the world.
  ShapePtr solid(const Node& node, const Affine& map);

 private:
  ShapePtr placed(const Node& node, const Affine& map);
  ShapePtr make_solid(const Node& node, const Affine& map);
  ShapePtr join_list(const Node& list, const Affine& map);

  const PlaneCut& cut_;
  Notes& notes_;
  std::unordered_map<const Node*, ShapePtr> made_;
};

}  // namespace isolux::rayshade
