#include "isolux/formats/openscad/operators.h"

#include <algorithm>

#include "isolux/formats/openscad/extrusion.h"
#include "isolux/formats/openscad/primitives.h"

namespace isolux::openscad {
namespace {

constexpr std::string_view kLeftOut[] = {"text", "import", "surface", "projection"};

constexpr std::string_view kLists[] = {"group", "union", "render", "color"};

/// Operators that diffuse surfaces could have, but true ones can't easily: with what is done.
constexpr std::pair<std::string_view, const char*> kApproximated[] = {
    {"hull", "'hull' is not known here: its children stand side by side"},
    {"minkowski", "'minkowski' is not known here: its first child stands for it"},
    {"resize", "'resize' is not known here: its children keep their size"},
    {"offset", "'offset' is not known here: outlines stay as drawn"},
    {"fill", "'fill' is not known here: holes stay"},
};

/// OpenSCAD writes six digits. A map that keeps angles within that is made to keep them, so that
/// what it turns stays a sphere or a cylinder.
Affine without_rounding(Affine map) {
  constexpr double kRounding = 4e-6;
  const auto& [x, y, z] = map.linear;
  const double factor = std::cbrt(std::abs(map.determinant()));
  const double off = std::max({std::abs(length(x) - factor), std::abs(length(y) - factor),
                               std::abs(length(z) - factor), std::abs(dot(x, y)) / factor,
                               std::abs(dot(y, z)) / factor, std::abs(dot(z, x)) / factor});
  if (!(off < kRounding * factor)) return map;
  const Vec3 u = normalized(x), v = tangential(y, u);
  const Vec3 w = cross(u, v) * (map.determinant() < 0 ? -1.0 : 1.0);
  map.linear = {u * factor, v * factor, w * factor};
  return map;
}

}  // namespace

Operator operator_of(const Context& context, const Node& node) {
  const std::span<const Node> all = node.children;
  if (node.name == "multmatrix") return {true, {}, all};
  if (node.name == "difference") return {false, CsgOperation::subtract, all};
  if (node.name == "intersection") return {false, CsgOperation::intersect, all};
  if (std::find(std::begin(kLists), std::end(kLists), node.name) != std::end(kLists)) {
    return {false, {}, all};
  }
  for (const auto& [name, note] : kApproximated) {
    if (name != node.name) continue;
    context.notes.add(note);
    return {false, {}, name == "minkowski" && !all.empty() ? all.first(1) : all};
  }
  std::vector<std::string_view> known = {
      "cube",   "sphere", "cylinder", "polyhedron", "linear_extrude", "rotate_extrude",
      "square", "circle", "polygon",  "multmatrix", "difference",     "intersection"};
  known.insert(known.end(), std::begin(kLists), std::end(kLists));
  context.tree.fail(node.place, fmt::format("unknown {}: {}", in_quotes(node.name),
                                            suggestion(node.name, known)));
}

bool is_left_out(const Context& context, const Node& node) {
  const auto* const found = std::find(std::begin(kLeftOut), std::end(kLeftOut), node.name);
  if (found == std::end(kLeftOut)) return false;
  context.notes.left_out(*found, "it is no true solid of the file itself");
  return true;
}

std::optional<Affine> map_of(const Context& context, const Node& node) {
  Affine map = Arguments(context.tree, node).matrix();
  map.translation *= context.unit;
  if (map.inverse()) return without_rounding(map);
  context.notes.add("a 'multmatrix' that flattens leaves nothing of what is in it");
  return std::nullopt;
}

void require_shallow(const Context& context, const Node& node, int depth) {
  constexpr int kDeepest = 40;
  if (depth <= kDeepest) return;
  context.tree.fail(
      node.place, fmt::format("differences and intersections nested more than {} deep: list their "
                              "operands side by side",
                              kDeepest));
}

}  // namespace isolux::openscad
