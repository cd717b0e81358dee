#pragma once

#include <map>
#include <tuple>

#include "isolux/formats/include_path.h"
#include "isolux/formats/mgf/contexts.h"
#include "isolux/formats/mgf/notes.h"
#include "isolux/formats/mgf/surface.h"
#include "isolux/formats/object_names.h"
#include "isolux/formats/scene_file.h"

namespace isolux::mgf {

/// Reads the entities of a file and of those that it includes into a scene.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file);

  void read(const SourceText& source);
  /// The scene, its name, camera and notes added.
  SceneFile finish();

 private:
  /// A transform that is not ended yet: where it began, and the maps to the world of all instances
  /// of what it holds.
  struct Transform {
    SourceLocation begin;
    std::vector<Affine> maps;
  };
  /// What a surface has of the material in force.
  struct UsedMaterial {
    std::uint32_t number;  ///< among the scene's
    Rgb exitance;          ///< lm/m²
  };
  using Action = void (Reader::*)(const Statement& s);
  static const std::map<std::string_view, Action> kActions;

  void read(const Statement& s);
  void select_vertex(const Statement& s) { vertices_.select(s); }
  void select_color(const Statement& s) { colors_.select(s); }
  void select_material(const Statement& s) { materials_.select(s); }
  void read_point(const Statement& s);
  void read_normal(const Statement& s);
  void read_chromaticity(const Statement& s);
  void read_spectrum(const Statement& s);
  void read_black_body(const Statement& s);
  void read_mix(const Statement& s);
  void read_sides(const Statement& s);
  void read_fraction(const Statement& s);
  void read_refraction(const Statement& s);
  void read_object(const Statement& s);
  void read_transform_entity(const Statement& s);
  void read_include(const Statement& s);
  void skip_luminaire(const Statement& s);

  void begin_transform(const Statement& s, std::size_t first);
  void add_surface(const Statement& s);
  /// A name for the next object: those of the o entities, numbered where they repeat.
  std::string next_name(const Statement& s);
  const UsedMaterial& current_material();

  Includes includes_;
  Contexts<Vertex> vertices_;
  Contexts<Color> colors_;
  Contexts<Material> materials_;
  std::vector<std::string> names_;     ///< of the open objects, each behind those that hold it
  std::vector<Transform> transforms_;  ///< open ones, the outermost first
  std::size_t own_names_ = 0;          ///< where those of the innermost file begin
  std::size_t own_transforms_ = 0;
  std::size_t maps_made_ = 0;
  double corner_pairs_ = 0;  ///< of all faces: the effort to make them

  NumberedNames object_names_, material_names_;
  std::map<std::tuple<std::string, Material>, UsedMaterial> used_materials_;
  std::map<std::tuple<std::string, double, double, double>, std::uint32_t> material_numbers_;
  Findings findings_;
  SceneFile result_;
};

}  // namespace isolux::mgf
