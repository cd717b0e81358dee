#pragma once

#include <functional>
#include <unordered_map>

#include "isolux/formats/notes.h"
#include "isolux/formats/rayshade/model.h"
#include "isolux/formats/rayshade/planes.h"
#include "isolux/scene/finish.h"

namespace isolux::rayshade {

/// A solid, and which of its faces have surfaces of their own.
struct Solid {
  ShapePtr shape;
  std::vector<FaceRun> faces;
};

/// Makes the solids that CSG joins, each but once however often it is mentioned.
///
/// Rayshade takes whatever a list holds for a closed surface. Here a cylinder or cone is closed by
/// caps, and discs of the same list that are its caps belong to it; triangles and polygons of a
/// list must together be watertight; what else a list holds is united; a plane is a half space.
class Solids {
 public:
  /// The material of a surface.
  using MaterialOf = std::function<std::uint32_t(const Surface& surface)>;

  Solids(const PlaneCut& cut, Notes& notes, MaterialOf material_of)
      : cut_(cut), notes_(notes), material_of_(std::move(material_of)) {}

  /// The solid, its own map left aside; `map` is from its frame to the world.
  Solid solid(const Node& node, const Affine& map);

 private:
  Solid placed(const Node& node, const Affine& map);
  Solid make_solid(const Node& node, const Affine& map);
  ShapePtr make_simple(const Node& node, const Affine& map);
  Solid join_list(const Node& list, const Affine& map);

  const PlaneCut& cut_;
  Notes& notes_;
  MaterialOf material_of_;
  std::unordered_map<const Node*, Solid> made_;
  std::size_t runs_ = 0;  ///< of faces, in all that was made
};

}  // namespace isolux::rayshade
