#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "isolux/core/affine.h"
#include "isolux/formats/notes.h"
#include "isolux/formats/object_names.h"
#include "isolux/formats/scene_file.h"
#include "isolux/scene/piece_count.h"

namespace isolux {

/// A surface's look, as formats with textures and shaders put it.
struct Look {
  std::string material;
  Rgb reflectance;
  Rgb exitance;            ///< lm/m², from the front
  bool two_sided = false;  ///< seen from both sides; else the back is black
};

/// A scene while a reader of a format made of polygons puts it together.
class Assembly {
 public:
  explicit Assembly(const std::string& name) { scene_.name = name; }

  Notes& notes() { return notes_; }
  PieceCount& pieces() { return pieces_; }
  std::vector<Source>& sources() { return scene_.sources; }
  std::vector<Camera>& cameras() { return scene_.cameras; }

  /// The mesh that is left of the triangles once they are mended (soup.h); null where nothing is.
  /// With `two_sided`, the winding says nothing: neighbours are made to agree, and what is closed
  /// to face outward. Throws InputError where the points are too far away, or all meshes together
  /// have too many triangles.
  std::shared_ptr<const Shape> mesh(TriangleSoup soup, bool two_sided);

  /// The mesh, once more, through a map.
  std::shared_ptr<const Shape> placed(const std::shared_ptr<const Shape>& mesh, const Affine& map);

  /// Adds an object, unless there is no shape. Names that come again are numbered. Throws
  /// InputError where there are too many, or the light is too strong.
  void add(const std::string& name, std::shared_ptr<const Shape> shape, const Look& look);

  /// The scene, with a camera; `up` is the axis that points up, where the format says so. Solids
  /// that are seen from both sides are turned over where they are rooms: where they have an eye or
  /// a light inside, and most of the scene. Throws InputError where there is no surface.
  SceneFile finish(std::optional<int> up = {});

 private:
  void count_items(std::size_t items);
  std::uint32_t material(const Look& look);
  void turn_rooms_over();

  Scene scene_;
  std::vector<bool> two_sided_;  ///< a flag an object
  Notes notes_;
  PieceCount pieces_;
  std::size_t items_ = 0;  ///< points and triangles of all meshes
  std::size_t flat_ = 0, repeated_ = 0, clamped_ = 0, two_sided_lights_ = 0;
  std::map<std::tuple<std::string, double, double, double>, std::uint32_t> materials_;
  NumberedNames material_names_, object_names_;
};

}  // namespace isolux
