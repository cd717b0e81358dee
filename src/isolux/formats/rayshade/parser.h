#pragma once

#include <map>
#include <set>
#include <string>

#include "isolux/formats/include_path.h"
#include "isolux/formats/notes.h"
#include "isolux/formats/rayshade/model.h"
#include "isolux/formats/rayshade/tokens.h"

namespace isolux::rayshade {

/// Reads the language of Rayshade 4 by recursive descent, one method a rule of its grammar
/// (Kolb, Rayshade User's Guide and Reference Manual, 1992).
class Parser {
 public:
  Parser(const SourceText& source, Notes& notes);
  Model parse();

 private:
  using Members = std::vector<std::shared_ptr<Node>>;
  /// Reads what follows the word of a primitive.
  using Primitive = void (Parser::*)(Node& node);

  // The scene, in parser.cpp.
  void mention_the_named(Members& world);
  bool view_item();
  bool light_item();
  void light(const Place& place);
  Vec3 point();
  [[noreturn]] void unknown_word(bool in_group);

  // Surfaces, in parse_surfaces.cpp.
  SurfacePtr surface();
  /// The one that follows, or the current one.
  SurfacePtr optional_surface();
  /// The same where a name must follow, which is no surface's unless there is more behind it.
  SurfacePtr surface_before_name();
  bool surface_follows();
  bool component_follows(std::size_t ahead = 0);
  void surface_component(Surface& surface);
  void surface_definition();

  // Objects, in parse_objects.cpp.
  /// Reads one thing that groups and the scene may hold, if such a thing follows.
  bool object_item(Members& members);
  static bool starts_object(const Token& token);
  static std::vector<std::string_view> object_words();
  std::shared_ptr<Node> object();
  void group(Node& node);
  void reference(Node& node);
  void finish(Node& node);
  std::optional<Affine> transforms();
  Affine transform(std::string_view word);

  // Primitives, in parse_primitives.cpp.
  static const std::map<std::string_view, Primitive>& primitives();
  void sphere(Node& node);
  void box(Node& node);
  void plane(Node& node);
  void cylinder(Node& node);
  void cone(Node& node);
  void tube(Node& node, double from_radius, const Vec3& from, double to_radius, const Vec3& to);
  void disc(Node& node);
  void torus(Node& node);
  void triangle(Node& node);
  void triangle_with_uv(Node& node);
  void facet(Node& node, const Vec3& a, const Vec3& b, const Vec3& c);
  void poly(Node& node);
  void blob(Node& node);
  void height_field(Node& node);

  // What is understood and left out, in skip.cpp.
  bool skip_option();
  static std::vector<std::string_view> option_words();
  void skip_textures();
  void skip_texture();
  void skip_mapping();
  void skip_atmosphere();

  Includes includes_;  ///< for height fields
  Notes& notes_;
  Tokens tokens_;
  Model model_;
  std::map<std::string, SurfacePtr, std::less<>> surfaces_;
  std::map<std::string, NodePtr, std::less<>> named_;
  std::set<const Node*> mentioned_;  ///< of the named
  std::vector<SurfacePtr> current_;  ///< of the scene and each group around, perhaps nothing
};

}  // namespace isolux::rayshade
