#include "isolux/formats/openscad/extrusion.h"

#include <algorithm>

#include "isolux/formats/openscad/operators.h"
#include "isolux/formats/openscad/primitives.h"
#include "isolux/formats/openscad/sweep.h"
#include "isolux/geometry/planar_region.h"

namespace isolux::openscad {
namespace {

/// Through the flat part of a 3D map.
Affine flattened(Affine map) {
  map.linear[0].z = map.linear[1].z = 0;
  map.linear[2] = {0, 0, 1};
  map.translation.z = 0;
  return map;
}

/// Without points that repeat the one before.
Outline cleaned(const Outline& outline) {
  Outline kept;
  for (const Vec3& p : outline) {
    if (kept.empty() || kept.back() != p) kept.push_back(p);
  }
  while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
  return kept;
}

/// Makes the drawing under an extrusion solid.
class Drawing {
 public:
  Drawing(const Context& context, const Sweep& sweep) : context_(context), sweep_(sweep) {}

  ShapePtr solid(const Node& node, const Affine& map, int depth) const;
  std::vector<ShapePtr> solids(std::span<const Node> nodes, const Affine& map, int depth) const;

 private:
  ShapePtr square(const Node& node, const Affine& map) const;
  ShapePtr circle(const Node& node, const Affine& map) const;
  ShapePtr polygon(const Node& node, const Affine& map) const;
  ShapePtr outlines(const Node& node, std::vector<Outline> outlines, const Affine& map) const;

  const Context& context_;
  const Sweep& sweep_;
};

std::vector<ShapePtr> Drawing::solids(std::span<const Node> nodes, const Affine& map,
                                      int depth) const {
  std::vector<ShapePtr> solids;
  for (const Node& child : nodes) {
    if (is_primitive(child) || is_extrusion(child)) {
      context_.notes.add("solids inside an extrusion are left out");
    } else if (!is_left_out(context_, child)) {
      solids.push_back(solid(child, map, depth));
    }
  }
  return solids;
}

ShapePtr Drawing::solid(const Node& node, const Affine& map, int depth) const {
  if (node.name == "square") return square(node, map);
  if (node.name == "circle") return circle(node, map);
  if (node.name == "polygon") return polygon(node, map);
  const Operator op = operator_of(context_, node);
  if (op.map) {
    const auto moved = map_of(context_, node);
    return moved ? combined(context_, node, CsgOperation::unite,
                            solids(op.operands, map * flattened(*moved), depth))
                 : nullptr;
  }
  if (op.operation) require_shallow(context_, node, ++depth);
  return combined(context_, node, op.operation.value_or(CsgOperation::unite),
                  solids(op.operands, map, depth));
}

ShapePtr Drawing::square(const Node& node, const Affine& map) const {
  const Arguments arguments(context_.tree, node);
  const std::vector<double> sides = arguments.numbers("size", 2);
  const double x = sides[0] * context_.unit, y = sides[1] * context_.unit;
  if (!(x > 0 && y > 0)) return nullptr;
  const Vec3 at = arguments.flag("center") ? Vec3{-0.5 * x, -0.5 * y, 0} : Vec3{};
  return outlines(node, {{at, at + Vec3{x, 0, 0}, at + Vec3{x, y, 0}, at + Vec3{0, y, 0}}}, map);
}

ShapePtr Drawing::circle(const Node& node, const Affine& map) const {
  const Arguments arguments(context_.tree, node);
  const double radius = arguments.number("r") * context_.unit;
  if (!(radius > 0)) return nullptr;
  if (const int corners = corner_count(arguments)) {
    return outlines(node, {regular_polygon(radius, corners)}, map);
  }
  return sweep_.circle(node, radius, map);
}

ShapePtr Drawing::polygon(const Node& node, const Affine& map) const {
  const Arguments arguments(context_.tree, node);
  Outline points = arguments.points("points", 2);
  for (Vec3& p : points) p *= context_.unit;
  std::vector<Outline> all;
  for (const auto& path : arguments.places("paths", points.size())) {
    Outline& outline = all.emplace_back();
    for (const std::uint32_t place : path) outline.push_back(points[place]);
  }
  if (all.empty()) all.push_back(points);
  return outlines(node, std::move(all), map);
}

/// The solids of what lies within an odd number of outlines: each of those around an odd number of
/// them, with those just inside as its holes.
ShapePtr Drawing::outlines(const Node& node, std::vector<Outline> outlines,
                           const Affine& map) const {
  constexpr std::size_t kMostOutlines = 200, kMostCorners = 1000;
  for (Outline& outline : outlines) {
    outline = cleaned(outline);
    for (Vec3& p : outline) p = map.point(p);
  }
  std::erase_if(outlines, [](const Outline& outline) { return outline.size() < 3; });
  if (outlines.size() > kMostOutlines) {
    context_.tree.fail(node.place, fmt::format("more than {} paths", kMostOutlines));
  }
  for (const Outline& outline : outlines) {
    if (outline.size() <= kMostCorners) continue;
    context_.tree.fail(node.place,
                       fmt::format("an outline of more than {} corners: use fewer", kMostCorners));
  }
  const auto around = [&](std::size_t outer, std::size_t inner) {
    Ring ring(outlines[outer].size());
    for (std::uint32_t i = 0; i < ring.size(); ++i) ring[i] = i;
    return outer != inner && encloses(outlines[outer], {ring}, outlines[inner].front());
  };
  std::vector<std::vector<std::size_t>> enclosing(outlines.size());
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    for (std::size_t k = 0; k < outlines.size(); ++k) {
      if (around(k, i)) enclosing[i].push_back(k);
    }
  }
  std::vector<ShapePtr> solids;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (enclosing[i].size() % 2 == 1) continue;
    std::vector<Outline> holes;
    for (std::size_t k = 0; k < outlines.size(); ++k) {
      const auto& rings = enclosing[k];
      if (rings.size() == enclosing[i].size() + 1 &&
          std::find(rings.begin(), rings.end(), i) != rings.end()) {
        holes.push_back(outlines[k]);
      }
    }
    solids.push_back(sweep_.polygon(node, outlines[i], holes));
  }
  return combined(context_, node, CsgOperation::unite, solids);
}

/// Whether something that is drawn, and not cut away, reaches to x > 0.
bool reaches_right(const Context& context, const Node& node, const Affine& map) {
  const Arguments arguments(context.tree, node);
  const auto right = [&](double x, double y) { return map.point({x, y, 0}).x > 0; };
  if (node.name == "square") {
    const std::vector<double> s = arguments.numbers("size", 2);
    const double x = arguments.flag("center") ? s[0] / 2 : 0;
    const double y = arguments.flag("center") ? s[1] / 2 : 0;
    return right(-x, -y) || right(s[0] - x, -y) || right(-x, s[1] - y) || right(s[0] - x, s[1] - y);
  }
  if (node.name == "circle") {
    const Vec3& row = map.linear[0];
    return map.translation.x + arguments.number("r") * std::hypot(row.x, row.y) > 0;
  }
  if (node.name == "polygon") {
    const Outline points = arguments.points("points", 2);
    return std::any_of(points.begin(), points.end(),
                       [&](const Vec3& p) { return right(p.x, p.y); });
  }
  Affine inner = map;
  if (node.name == "multmatrix") inner = map * flattened(arguments.matrix());
  for (const Node& child : node.children) {
    if (reaches_right(context, child, inner)) return true;
    if (node.name == "difference") break;
  }
  return false;
}

ShapePtr linear_extrude(const Context& context, const Node& node, const Affine& map, int depth) {
  const LinearSweep sweep(context, node);
  if (!sweep.has_volume()) return nullptr;
  const auto solids = Drawing(context, sweep).solids(node.children, {}, depth);
  return placed(context, node, combined(context, node, CsgOperation::unite, solids), map);
}

ShapePtr rotate_extrude(const Context& context, const Node& node, const Affine& map, int depth) {
  constexpr double kDegree = 0.017453292519943295;
  double angle = Arguments(context.tree, node).number("angle", 360);
  if (angle == 0) return nullptr;
  if (!(std::abs(angle) < 360)) angle = 360;
  // Backwards is forwards to where it began.
  Affine turn = map;
  if (angle < 0) turn = turn * Affine::rotate({0, 0, 1}, angle * kDegree);
  const RotarySweep sweep(context, std::abs(angle));
  // What is drawn on the left turns there.
  Affine drawing;
  if (!reaches_right(context, node, {})) {
    drawing = Affine::scale({-1, 1, 1});
    turn = turn * Affine::rotate({0, 0, 1}, 180 * kDegree);
  }
  const auto solids = Drawing(context, sweep).solids(node.children, drawing, depth);
  return placed(context, node, combined(context, node, CsgOperation::unite, solids), turn);
}

}  // namespace

ShapePtr extrusion(const Context& context, const Node& node, const Affine& map, int depth) {
  return node.name == "linear_extrude" ? linear_extrude(context, node, map, depth)
                                       : rotate_extrude(context, node, map, depth);
}

bool is_extrusion(const Node& node) {
  return node.name == "linear_extrude" || node.name == "rotate_extrude";
}

bool is_flat_shape(const Node& node) {
  return node.name == "square" || node.name == "circle" || node.name == "polygon";
}

}  // namespace isolux::openscad
