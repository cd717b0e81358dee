#include "isolux/formats/openscad/reader.h"

#include <fmt/format.h>

#include <new>

#include "isolux/core/file.h"
#include "isolux/formats/default_camera.h"
#include "isolux/formats/limits.h"
#include "isolux/formats/openscad/extrusion.h"
#include "isolux/formats/openscad/operators.h"
#include "isolux/formats/openscad/primitives.h"
#include "isolux/formats/openscad/side_file.h"

namespace isolux {
namespace {

using namespace openscad;
using openscad::Color;

class Builder {
 public:
  Builder(const Tree& tree, SideFile& side_file, Notes& notes)
      : context_{tree, side_file.unit(), notes}, side_file_(side_file) {}

  Scene build();

 private:
  Color color_of(const Node& node, const Color& around);
  void add(const Node& node, const Affine& map, const Color& color);
  void add_object(const Node& node, const Affine& map, Color color);
  ShapePtr solid(const Node& node, const Affine& map, int depth);
  std::vector<ShapePtr> solids(std::span<const Node> nodes, const Affine& map, int depth);
  void collect_colors(const Node& node, const Color& around, std::vector<Color>& colors);

  Context context_;
  SideFile& side_file_;
  Scene scene_;
};

/// The color of what is in the node: as in OpenSCAD, an outer color goes before an inner one.
Color Builder::color_of(const Node& node, const Color& around) {
  if (node.name != "color" || around) return around;
  const auto [r, g, b, opacity] = Arguments(context_.tree, node).color();
  if (r < 0) return around;
  if (opacity < 1) context_.notes.left_out("opacity", "surfaces are opaque");
  const auto code = [](double channel) { return static_cast<int>(std::lround(channel * 255)); };
  return std::array{code(r), code(g), code(b)};
}

/// The colors of the solids of a node.
void Builder::collect_colors(const Node& node, const Color& around, std::vector<Color>& colors) {
  const Color color = color_of(node, around);
  if (is_primitive(node) || is_extrusion(node)) colors.push_back(color);
  for (const Node& child : node.children) {
    if (!is_extrusion(node)) collect_colors(child, color, colors);
  }
}

ShapePtr Builder::solid(const Node& node, const Affine& map, int depth) {
  if (is_primitive(node)) return primitive(context_, node, map);
  if (is_extrusion(node)) return extrusion(context_, node, map, depth);
  const Operator op = operator_of(context_, node);
  if (op.map) {
    const auto moved = map_of(context_, node);
    if (!moved) return nullptr;
    return combined(context_, node, CsgOperation::unite, solids(op.operands, map * *moved, depth));
  }
  if (op.operation) require_shallow(context_, node, ++depth);
  return combined(context_, node, op.operation.value_or(CsgOperation::unite),
                  solids(op.operands, map, depth));
}

std::vector<ShapePtr> Builder::solids(std::span<const Node> nodes, const Affine& map, int depth) {
  std::vector<ShapePtr> solids;
  for (const Node& node : nodes) {
    if (is_flat_shape(node)) {
      context_.notes.add("flat shapes that are not extruded are left out");
    } else if (!is_left_out(context_, node)) {
      solids.push_back(solid(node, map, depth));
    }
  }
  return solids;
}

void Builder::add_object(const Node& node, const Affine& map, Color color) {
  Object object;
  object.shape = solid(node, map, 0);
  if (!object.shape) return;
  if (scene_.objects.size() == kMostObjects) {
    context_.tree.fail(node.place, fmt::format("more than {} solids", kMostObjects));
  }
  if (!color) {
    std::vector<Color> colors;
    collect_colors(node, color, colors);
    for (const Color& other : colors) {
      if (other == colors.front()) continue;
      context_.notes.add("a solid cut out of several colors has that of its first part");
      break;
    }
    if (!colors.empty()) color = colors.front();
  }
  object.material = side_file_.material(color);
  object.name = fmt::format("{} {}", node.name, scene_.objects.size() + 1);
  object.sides = object.shape->solid() ? Sides::front : Sides::both;
  object.exitance = side_file_.exitance(object.material, *object.shape);
  scene_.objects.push_back(std::move(object));
}

/// Adds the objects of a node: of what is listed or moved each by itself, of what is cut one.
void Builder::add(const Node& node, const Affine& map, const Color& around) {
  if (is_flat_shape(node)) {
    context_.notes.add("flat shapes that are not extruded are left out");
    return;
  }
  if (is_left_out(context_, node)) return;
  if (is_primitive(node) || is_extrusion(node)) return add_object(node, map, around);
  const Operator op = operator_of(context_, node);
  if (op.operation) return add_object(node, map, around);
  const Color color = color_of(node, around);
  Affine inner = map;
  if (op.map) {
    const auto moved = map_of(context_, node);
    if (!moved) return;
    inner = map * *moved;
  }
  for (const Node& child : op.operands) add(child, inner, color);
}

Scene Builder::build() {
  for (const Node& node : context_.tree.nodes) add(node, {}, {});
  if (scene_.objects.empty()) {
    throw InputError({context_.tree.file, 1, 1}, "the model is empty: there is no solid in it");
  }
  scene_.materials = side_file_.materials();
  scene_.sources = side_file_.sources();
  scene_.cameras = side_file_.cameras();
  return std::move(scene_);
}

SceneFile read(const std::filesystem::path& path) {
  const std::string text = read_file(path, kLargestMainFile);
  const Tree tree = parse(text, path.string());
  Notes notes;
  SideFile side_file(path, notes);
  SceneFile file;
  file.scene = Builder(tree, side_file, notes).build();
  file.scene.name = path.stem().string();
  if (file.scene.cameras.empty()) file.scene.cameras.push_back(default_camera(file.scene));
  file.notes = notes.lines();
  return file;
}

}  // namespace

SceneFile read_openscad(const std::filesystem::path& path) {
  try {
    return read(path);
  } catch (const std::bad_alloc&) {
    throw InputError({path.string()}, "the model needs more memory than there is: make it smaller");
  }
}

}  // namespace isolux
