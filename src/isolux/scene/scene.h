#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"
#include "isolux/geometry/shape.h"
#include "isolux/scene/sky.h"
#include "isolux/scene/source.h"

namespace isolux {

/// A perfectly diffuse surface.
struct Material {
  std::string name;
  Rgb reflectance;  ///< ρ per channel, 0 ≤ ρ < 1
};

/// Which sides of an object's surface take part in the exchange of light. Every surface blocks
/// light from both sides.
enum class Sides {
  front,  ///< only the side its normals point to; the other is black
  both,   ///< both, alike: the default of open surfaces (solids have no inner side)
};

/// A shape with its material; a light where it emits.
struct Object {
  std::string name;
  std::shared_ptr<const Shape> shape;
  std::uint32_t material = 0;  ///< index into Scene::materials
  Sides sides = Sides::front;
  Rgb exitance;  ///< emitted light, lm/m² (from the front side only), zero for all but lights

  /// Emits for the proof of a solve only: what none but such light reaches need not be covered.
  bool glows = false;

  bool emits() const { return max_channel(exitance) > 0; }
};

/// A pinhole camera.
struct Camera {
  std::string name;
  Vec3 eye;          ///< m
  Vec3 look_at;      ///< m, differs from eye
  Vec3 up{0, 0, 1};  ///< not parallel to the view
  double fov = 50;   ///< of the picture's height, degrees, 0 < fov < 180
  int width = 800;   ///< pixels
  int height = 600;  ///< pixels

  /// The ray through (x, y) in [0, 1]², from the left and from the top; unit direction.
  Ray ray(double x, double y, double aspect) const;
  Ray ray(double x, double y) const { return ray(x, y, double(width) / height); }
};

/// What is lit: plain data, in metres, z up by custom only.
struct Scene {
  std::string name;
  std::vector<Material> materials;
  std::vector<Object> objects;
  std::vector<Source> sources;  ///< lights besides the objects that emit
  std::optional<Sky> sky;       ///< what surrounds it; without, it is dark outside
  std::vector<Camera> cameras;
  std::string source;      ///< the text it was read from, in the native format
  std::string unit = "m";  ///< the unit of the plain numbers in `source`

  Bounds bounds() const;
  /// The camera of that name (the first where `name` is empty). Throws InputError that lists the
  /// names there are.
  const Camera& camera(const std::string& name) const;
  /// Whether an object, a source or the sky gives light.
  bool has_light() const;
  const Material& material_of(std::uint32_t object) const {
    return materials[objects[object].material];
  }
};

/// Area of a shape's surface in m²: by its formula, else that of its triangles; nothing where the
/// shape has neither.
std::optional<double> surface_area(const Shape& shape);

/// The luminous flux that an object emits, lm; 0 for all but lights.
double luminous_flux(const Object& object);

}  // namespace isolux
