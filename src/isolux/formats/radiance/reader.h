#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "isolux/core/affine.h"
#include "isolux/formats/include_path.h"
#include "isolux/formats/notes.h"
#include "isolux/formats/object_names.h"
#include "isolux/formats/radiance/generators.h"
#include "isolux/formats/radiance/materials.h"
#include "isolux/formats/radiance/scanner.h"
#include "isolux/formats/radiance/skies.h"
#include "isolux/formats/radiance/view.h"
#include "isolux/formats/scene_file.h"
#include "isolux/formats/soup.h"

namespace isolux::radiance {

/// What the programs around a primitive do to it.
struct Context {
  std::vector<Affine> maps{Affine{}};  ///< to the world, one for each instance
  bool turned_over = false;
  std::string prefix;                   ///< of names, "desk."
  std::optional<std::string> modifier;  ///< of all surfaces, in place of their own

  std::string prefixed(std::string_view name) const;
};

/// Reads the primitives and commands of a file and of those that it refers to into a scene.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& file);

  /// A scene description.
  void read(const SourceText& source) { read(Scanner(source), {}); }
  /// The input of Radiance's program rad (.rif), which names the files and views of a scene.
  void read_project(const SourceText& source);
  /// Adds the views that stand beside the scene's file, the one of its own name first.
  void add_view_files();
  /// The scene with its cameras and notes. Throws InputError, without a place, where it is empty.
  SceneFile finish();

 private:
  void read(Scanner scanner, const Context& context);
  void read_file(const Statement& s, std::size_t i, const Context& context);
  void add(const Primitive& primitive, const Context& context);
  void add_surface(const Surface& surface, std::string_view word, const Finish& finish,
                   const Context& context);
  void add_source(const Primitive& primitive, std::string_view modifier, const Context& context);
  void add_instance(const Primitive& primitive, const Context& context);
  void add_mesh(const Primitive& primitive, const Context& context);
  /// What is left of the triangles once they are mended.
  Surface mesh_surface(TriangleSoup soup, bool two_sided);
  /// The maps of a primitive that places a file.
  std::vector<Affine> maps_of(const Primitive& primitive, const Context& context);
  /// Opens the file of that extension beside the one that a primitive names; nothing where there is
  /// none.
  [[nodiscard]] std::optional<SourceText> open_beside(const Primitive& primitive,
                                                      std::string_view extension);
  void require_room(const Surface& surface, std::size_t places);
  std::uint32_t material_number(const Finish& finish);

  // Commands, in commands.cpp.
  void run(const Command& command, const Context& context);
  void run(const Statement& program, const Context& context);
  /// The context of what xform reads; `at` moves behind its options.
  Context transformed(const Statement& xform, std::size_t& at, const Context& outer);
  /// The maps, each behind the transform from word `at` on, which moves behind it.
  std::vector<Affine> placed(const Statement& s, std::size_t& at, const std::vector<Affine>& outer);

  // Projects and views, in project.cpp.
  void read_project_files(const SourceText& source, const Statement& names);
  void read_project_view(const Statement& words, const Vec3& up);
  /// Whether the view is one that a camera can have.
  bool add_camera(const View& view);

  std::filesystem::path file_;
  Includes includes_;
  Notes notes_;
  Surroundings around_{includes_, notes_};
  Materials materials_{notes_};
  Skies skies_{notes_};
  SceneFile result_;
  NumberedNames object_names_, material_names_;
  std::unordered_map<std::string, std::uint32_t> material_numbers_;  ///< by name and reflectance
  std::size_t left_out_ = 0;                                         ///< surfaces
  std::size_t surfaces_ = 0, triangles_ = 0, maps_made_ = 0;
  double corner_pairs_ = 0;
  std::unordered_map<std::string, Surface> meshes_;  ///< by name, and how they are lit
  Cutting cutting_;                                  ///< of their polygons
  bool has_own_view_ = false;  ///< a view of the scene's own name, or of its project
};

}  // namespace isolux::radiance
