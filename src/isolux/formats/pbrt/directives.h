#pragma once

#include "isolux/formats/assembly.h"
#include "isolux/formats/pbrt/parameters.h"
#include "isolux/formats/texture.h"

namespace isolux::pbrt {

/// Carries out the directives of a file, and of those that it includes.
class Directives {
 public:
  explicit Directives(const std::filesystem::path& path)
      : includes_(path, Includes::Base::main_file), assembly_(path.stem().string()) {}

  void read(const SourceText& source);
  SceneFile finish();

 private:
  /// What AttributeBegin keeps.
  struct State {
    Affine map;
    Look look{"unnamed", gray(0.5), {}, true};
    std::optional<Rgb> emitted;  ///< exitance of the shapes that follow, lm/m²
    double flux = 0;             ///< of each of them, lm; 0 where `emitted` says it all
    bool reversed = false;
  };
  struct Part {
    std::string name;
    std::shared_ptr<const Shape> shape;
    Look look;
  };
  using Action = void (Directives::*)(const Token& directive, Lexer& lexer);
  static const std::map<std::string_view, Action> kActions;

  void run(const Token& directive, Lexer& lexer);
  void begin(const Token& directive, Lexer& lexer);
  void end(const Token& directive, Lexer& lexer);
  void transform(const Token& directive, Lexer& lexer);
  void coordinate_system(const Token& directive, Lexer& lexer);
  void reverse(const Token& directive, Lexer& lexer);
  void begin_world(const Token& directive, Lexer& lexer);
  void include(const Token& directive, Lexer& lexer);
  void camera(const Token& directive, Lexer& lexer);
  void film(const Token& directive, Lexer& lexer);
  void material(const Token& directive, Lexer& lexer);
  void named_material(const Token& directive, Lexer& lexer);
  void texture(const Token& directive, Lexer& lexer);
  void area_light(const Token& directive, Lexer& lexer);
  void light(const Token& directive, Lexer& lexer);
  void shape(const Token& directive, Lexer& lexer);
  void begin_object(const Token& directive, Lexer& lexer);
  void end_object(const Token& directive, Lexer& lexer);
  void place_object(const Token& directive, Lexer& lexer);
  void skip(const Token& directive, Lexer& lexer);

  /// The colour that a parameter names, or that of the texture.
  std::optional<Rgb> color(const Parameters& parameters, std::string_view name) const;
  Look look_of(std::string_view kind, const Parameters& parameters, const std::string& name);

  Includes includes_;
  Assembly assembly_;
  Textures images_;
  State state_;
  std::vector<std::pair<std::string_view, State>> kept_;  ///< by the directive that ends it
  std::map<std::string, Affine, std::less<>> systems_;
  std::map<std::string, Look, std::less<>> materials_;
  std::map<std::string, Rgb, std::less<>> textures_;
  std::map<std::string, std::vector<Part>, std::less<>> objects_;
  std::vector<Part>* object_ = nullptr;  ///< that is being defined
  std::optional<Camera> camera_;
  double shorter_fov_ = 90;  ///< of the camera, degrees
  int width_ = 1280, height_ = 720;
};

/// The text that must come next.
std::string take_text(const Token& directive, Lexer& lexer);
/// The numbers that must come next, in brackets or not.
std::vector<double> take_numbers(const Token& directive, Lexer& lexer, std::size_t count);

}  // namespace isolux::pbrt
