#include "isolux/formats/mgf/write_mgf.h"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <tuple>

#include "isolux/formats/identifiers.h"
#include "isolux/formats/simple_surface.h"

namespace isolux {
namespace {

// "No extended line may exceed 4096 characters": so many vertices named v0, v1 ... fit on one.
const SurfaceFormat kMgf{"MGF", true, 800};

/// What `keyword` says of a colour: its luminance, after a color context, which is the unnamed
/// neutral one for grey. Neutral is equal-energy white in MGF and D65 in Rec. 709; the matrix is
/// Rec. 709 to XYZ and then the adaptation between the two (linear Bradford).
std::string colored(const char* keyword, const Rgb& color) {
  if (color == gray(color.r)) return fmt::format("\tc\n\t{} {}\n", keyword, color.r);
  const double x = 0.4384488 * color.r + 0.3921759 * color.g + 0.1693753 * color.b;
  const double y = 0.2228277 * color.r + 0.7086913 * color.g + 0.0684810 * color.b;
  const double z = 0.0173137 * color.r + 0.1104450 * color.g + 0.8722412 * color.b;
  const double sum = x + y + z;
  return fmt::format("\tc\n\t\tcxy {} {}\n\t{} {}\n", x / sum, y / sum, keyword, luminance(color));
}

/// Writes the entities of a scene: all materials first, then the objects.
class MgfText {
 public:
  explicit MgfText(const Scene& scene) : scene_(scene) {}

  void add(const Object& object, const std::vector<SimpleSurface>& surfaces) {
    add("m {}\no {}\n", material_of(object), identifier(object.name));
    for (const SimpleSurface& surface : surfaces) {
      std::visit([&](const auto& s) { add(s); }, surface);
    }
    add("o\n");
  }

  std::string text() const { return materials_ + '\n' + objects_; }

 private:
  template <typename... Arguments>
  void add(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(std::back_inserter(objects_), format, std::forward<Arguments>(arguments)...);
  }

  /// The material with the light that the object emits and its sides.
  const std::string& material_of(const Object& object) {
    // A light shines from its front alone.
    const int sides = object.sides == Sides::both && !object.emits() ? 2 : 1;
    const Rgb& exitance = object.exitance;
    std::string& id = ids_[{object.material, sides, exitance.r, exitance.g, exitance.b}];
    if (!id.empty()) return id;
    const Material& material = scene_.materials[object.material];
    id = names_.next(material.name);
    materials_ += fmt::format("m {} =\n\tsides {}\n", id, sides);
    materials_ += colored("rd", material.reflectance);
    if (object.emits()) materials_ += colored("ed", exitance);
    return id;
  }

  void vertex(std::size_t i, const Vec3& p) { add("v v{} =\n\tp {} {} {}\n", i, p.x, p.y, p.z); }
  void normal(const Vec3& n) { add("\tn {} {} {}\n", n.x, n.y, n.z); }

  void add(const SphereSurface& s) {
    vertex(0, s.center);
    add("sph v0 {}\n", s.inward ? -s.radius : s.radius);
  }

  void add(const ConeSurface& s) {
    const double sign = s.inward ? -1 : 1;
    vertex(0, s.from);
    vertex(1, s.to);
    if (s.from_radius == s.to_radius) {
      add("cyl v0 {} v1\n", sign * s.from_radius);
    } else {
      add("cone v0 {} v1 {}\n", sign * s.from_radius, sign * s.to_radius);
    }
  }

  void add(const RingSurface& s) {
    vertex(0, s.center);
    normal(s.normal);
    add("ring v0 {} {}\n", s.inner_radius, s.outer_radius);
  }

  void add(const TorusSurface& s) {
    const double sign = s.inward ? -1 : 1;
    vertex(0, s.center);
    normal(s.axis);
    add("torus v0 {} {}\n", sign * (s.major_radius - s.minor_radius),
        sign * (s.major_radius + s.minor_radius));
  }

  void add(const FacesSurface& s) {
    for (std::size_t i = 0; i < s.points.size(); ++i) vertex(i, s.points[i]);
    for (const auto& face : s.faces) {
      add("f");
      for (const std::uint32_t corner : face) add(" v{}", corner);
      add("\n");
    }
  }

  const Scene& scene_;
  std::string materials_, objects_;
  Identifiers names_;
  std::map<std::tuple<std::uint32_t, int, double, double, double>, std::string> ids_;
};

/// What MGF's sides can't say.
void note_sides(const Scene& scene, std::vector<std::string>& notes) {
  bool black_backs = false, bright_backs = false;
  for (const Object& object : scene.objects) {
    black_backs |= object.sides == Sides::front && !object.shape->solid();
    bright_backs |= object.sides == Sides::both && object.emits();
  }
  if (black_backs) {
    notes.emplace_back("black backs of surfaces become one-sided materials, unseen from behind");
  }
  if (bright_backs) {
    notes.emplace_back("lights that reflect on their backs become one-sided, unseen from behind");
  }
}

}  // namespace

WrittenScene write_mgf(const Scene& scene) {
  MgfText text(scene);
  std::vector<Triangulated> triangulated;
  for (const Object& object : scene.objects) {
    text.add(object, simple_surfaces(object, kMgf, triangulated));
  }
  WrittenScene written{text.text(), notes_of(scene, kMgf, triangulated)};
  note_sides(scene, written.notes);
  return written;
}

}  // namespace isolux
