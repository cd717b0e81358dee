#include "isolux/formats/radiance/write_radiance.h"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <numbers>
#include <tuple>

#include "isolux/formats/colorimetry.h"
#include "isolux/formats/identifiers.h"
#include "isolux/formats/radiance/write_sky.h"
#include "isolux/formats/simple_surface.h"

namespace isolux {
namespace {

const SurfaceFormat kRadiance{"Radiance", false, 1000, true};

/// Writes the primitives of a scene: all materials first, then the objects. A primitive is
/// "modifier type name", and three lists headed by their lengths: words, nothing, numbers.
class RadianceText {
 public:
  explicit RadianceText(const Scene& scene) : scene_(scene) {}

  void add(const Object& object, const std::vector<SimpleSurface>& surfaces) {
    const std::string& material = material_of(object);
    const std::string name = identifier(object.name);
    for (const SimpleSurface& surface : surfaces) {
      std::visit([&](const auto& s) { add(s, material, name); }, surface);
    }
  }

  void add_light_from_infinity(std::vector<std::string>& notes) {
    objects_ += radiance::light_from_infinity(scene_, names_, notes);
  }

  std::string text() const { return materials_ + objects_; }

 private:
  const std::string& material_of(const Object& object) {
    const Rgb& e = object.exitance;
    // Lights do not reflect, so that the material of one is its light alone.
    const std::uint32_t material = object.emits() ? 0 : object.material;
    std::string& id = ids_[{material, e.r, e.g, e.b}];
    if (!id.empty()) return id;
    const Material& surface = scene_.materials[object.material];
    id = names_.next(surface.name);
    if (object.emits()) {
      const Rgb radiance = radiance_of_luminance(e / std::numbers::pi);
      fmt::format_to(std::back_inserter(materials_), "void light {}\n0\n0\n3 {} {} {}\n\n", id,
                     radiance.r, radiance.g, radiance.b);
    } else {
      const Rgb& reflectance = surface.reflectance;
      fmt::format_to(std::back_inserter(materials_), "void plastic {}\n0\n0\n5 {} {} {} 0 0\n\n",
                     id, reflectance.r, reflectance.g, reflectance.b);
    }
    return id;
  }

  void primitive(const std::string& material, const char* type, const std::string& name,
                 std::initializer_list<double> numbers) {
    const auto out = std::back_inserter(objects_);
    fmt::format_to(out, "{} {} {}\n0\n0\n{} {}\n\n", material, type, name, numbers.size(),
                   fmt::join(numbers, " "));
  }

  void add(const SphereSurface& s, const std::string& material, const std::string& name) {
    primitive(material, s.inward ? "bubble" : "sphere", name,
              {s.center.x, s.center.y, s.center.z, s.radius});
  }

  void add(const ConeSurface& s, const std::string& material, const std::string& name) {
    if (s.from_radius == s.to_radius) {
      primitive(material, s.inward ? "tube" : "cylinder", name,
                {s.from.x, s.from.y, s.from.z, s.to.x, s.to.y, s.to.z, s.from_radius});
    } else {
      primitive(material, s.inward ? "cup" : "cone", name,
                {s.from.x, s.from.y, s.from.z, s.to.x, s.to.y, s.to.z, s.from_radius, s.to_radius});
    }
  }

  void add(const RingSurface& s, const std::string& material, const std::string& name) {
    primitive(material, "ring", name,
              {s.center.x, s.center.y, s.center.z, s.normal.x, s.normal.y, s.normal.z,
               s.inner_radius, s.outer_radius});
  }

  /// Radiance has none: SurfaceFormat::torus.
  void add(const TorusSurface&, const std::string&, const std::string&) {}

  void add(const FacesSurface& s, const std::string& material, const std::string& name) {
    const auto out = std::back_inserter(objects_);
    for (const auto& face : s.faces) {
      fmt::format_to(out, "{} polygon {}\n0\n0\n{}\n", material, name, 3 * face.size());
      for (const std::uint32_t corner : face) {
        const Vec3& p = s.points[corner];
        fmt::format_to(out, "{} {} {}\n", p.x, p.y, p.z);
      }
      objects_ += '\n';
    }
  }

  const Scene& scene_;
  std::string materials_, objects_;
  Identifiers names_{{"void"}};
  std::map<std::tuple<std::uint32_t, double, double, double>, std::string> ids_;
};

/// What Radiance's surfaces can't be: they reflect on both sides, and lights on none.
void note_sides(const Scene& scene, std::vector<std::string>& notes) {
  bool black_backs = false, reflecting_lights = false;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    const Rgb& reflectance = scene.material_of(static_cast<std::uint32_t>(i)).reflectance;
    const bool reflects = max_channel(reflectance) > 0;
    reflecting_lights |= object.emits() && reflects;
    black_backs |=
        !object.emits() && reflects && object.sides == Sides::front && !object.shape->solid();
  }
  if (black_backs) notes.emplace_back("black backs of surfaces reflect like their fronts");
  if (reflecting_lights) notes.emplace_back("lights lose their reflectance");
}

}  // namespace

WrittenScene write_radiance(const Scene& scene) {
  RadianceText text(scene);
  std::vector<Triangulated> triangulated;
  for (const Object& object : scene.objects) {
    text.add(object, simple_surfaces(object, kRadiance, triangulated));
  }
  std::vector<std::string> notes = notes_of(scene, kRadiance, triangulated);
  text.add_light_from_infinity(notes);
  WrittenScene written{text.text(), std::move(notes)};
  note_sides(scene, written.notes);
  return written;
}

}  // namespace isolux
