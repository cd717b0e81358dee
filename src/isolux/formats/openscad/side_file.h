#pragma once

#include <filesystem>

#include "isolux/formats/notes.h"
#include "isolux/scene/scene.h"
#include "isolux/scene/value.h"

namespace isolux::openscad {

/// A color of a model, 8 bits a channel; nothing for what has none.
using Color = std::optional<std::array<int, 3>>;

/// What a model of OpenSCAD can't say: how its colors reflect and which of them shine, the lights,
/// the cameras, and its unit. It stands in MODEL.lights.yaml beside MODEL.csg (docs/formats.md).
class SideFile {
 public:
  /// Reads the file of that model; all is left to its default where there is none. Throws
  /// InputError with file, line and column.
  SideFile(const std::filesystem::path& model, Notes& notes);

  double unit() const { return context_.metres_per_unit; }  ///< m
  const std::vector<Source>& sources() const { return sources_; }
  const std::vector<Camera>& cameras() const { return cameras_; }

  /// What surfaces of the color are made of: its index in materials().
  std::uint32_t material(const Color& color);
  const std::vector<Material>& materials() const { return materials_; }
  /// The light that a shape of that material emits, lm/m².
  Rgb exitance(std::uint32_t material, const Shape& shape) const;

 private:
  void read(const Value& root);
  void read_material(const Value& name, const Value& value);

  YamlDocument document_;
  ReadingContext context_;
  std::vector<Material> materials_;
  std::vector<std::pair<Color, std::optional<Value>>> looks_;  ///< color and emission of each
  std::vector<Source> sources_;
  std::vector<Camera> cameras_;
};

}  // namespace isolux::openscad
