#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "isolux/core/affine.h"
#include "isolux/core/color.h"
#include "isolux/formats/rayshade/place.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/shape.h"

namespace isolux::rayshade {

using ShapePtr = std::shared_ptr<const Shape>;

/// What a surface keeps of all that the language says about it.
struct Surface {
  std::string name;
  Rgb diffuse;
};

using SurfacePtr = std::shared_ptr<const Surface>;

/// Rayshade's own, where a file names none.
const SurfacePtr& default_surface();

struct Node;
using NodePtr = std::shared_ptr<const Node>;

/// The side of a cylinder or cone: open, but taken as closed where CSG needs a solid.
struct Tube {
  Vec3 from, to;
  double from_radius, to_radius;
  ShapePtr side;
};
struct Disc {
  Vec3 center, normal;
  double radius;
  ShapePtr shape;
};
/// Infinite; in CSG all that lies behind it.
struct Plane {
  Vec3 point, normal;
};
/// Triangles, or a polygon cut into them.
struct Facets {
  TriangleSoup soup;
  ShapePtr polygon;
};
/// A list, or a solid of several by an operation.
struct Group {
  std::optional<CsgOperation> operation;
  std::vector<NodePtr> members;
};
/// Another mention of a named object.
struct Reference {
  NodePtr target;
};

/// An object of the scene.
struct Node {
  std::variant<ShapePtr, Tube, Disc, Plane, Facets, Group, Reference> geometry;
  std::string_view word;  ///< that it is written with; lives on
  std::string name;
  Place place;
  std::optional<Affine> map;  ///< its own transforms
  SurfacePtr surface;         ///< nothing: that of what is around it
  std::size_t leaves = 1;     ///< objects that it comes to
  int depth = 1;              ///< of groups and references within it
  bool has_planes = false;
};

struct Light {
  enum class Kind { point, directional, extended, spot, area };
  Kind kind = Kind::point;
  Place place;
  Rgb intensity;
  Vec3 position;                            ///< of an area light its corner
  Vec3 direction;                           ///< towards a directional light; from a spot light
  Vec3 u, v;                                ///< the edges of an area light
  double radius = 0;                        ///< of an extended light
  double full_angle = 90, dark_angle = 90;  ///< of a spot light, degrees off its middle
};

/// How the scene is looked at: what the file leaves out is as Rayshade has it.
struct View {
  Vec3 eye{0, -10, 0}, look_at, up{0, 0, 1};
  double horizontal_fov = 45;          ///< degrees
  std::optional<double> vertical_fov;  ///< degrees
  int width = 512, height = 512;       ///< pixels
  std::optional<Place> place;          ///< of the last word about it
};

/// All that was read from a file.
struct Model {
  std::vector<NodePtr> objects;
  std::vector<Light> lights;
  View view;
};

}  // namespace isolux::rayshade
