#include "isolux/formats/openscad/sweep.h"

#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/prism.h"
#include "isolux/geometry/revolution.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"

namespace isolux::openscad {
namespace {

constexpr int kCircleCorners = 96;

/// The factor by which the map stretches the plane z = 0, if it is the same in all directions.
std::optional<double> flat_similarity(const Affine& map) {
  const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0});
  const double a = length(x), b = length(y);
  if (std::abs(a - b) > 1e-9 * a || std::abs(dot(x, y)) > 1e-9 * a * b) return std::nullopt;
  return a;
}

/// The part of a polygon at x ≥ 0 (Sutherland and Hodgman 1974).
Outline right_half(const Outline& outline) {
  Outline kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if (a.x >= 0) kept.push_back(a);
    if ((a.x < 0) != (b.x < 0)) {
      kept.push_back({0, a.y + (b.y - a.y) * (a.x / (a.x - b.x)), 0});
    }
  }
  return kept;
}

}  // namespace

ShapePtr Sweep::circle_of_corners(const Node& node, double radius, const Affine& map) const {
  context_.notes.add(fmt::format(
      "circles in extrusions that make no cone, torus or sphere of them are polygons of {} corners",
      kCircleCorners));
  Outline outline = regular_polygon(radius, kCircleCorners);
  for (Vec3& p : outline) p = map.point(p);
  return polygon(node, outline, {});
}

LinearSweep::LinearSweep(const Context& context, const Node& node) : Sweep(context) {
  const Arguments arguments(context.tree, node);
  height_ = arguments.number("height") * context.unit;
  base_ = arguments.flag("center") ? -0.5 * height_ : 0;
  twist_ = -arguments.number("twist", 0);
  if (node.find("scale")) {
    const std::vector<double> factors = arguments.numbers("scale", 2);
    scale_ = {std::max(0.0, factors[0]), std::max(0.0, factors[1])};
  }
}

ShapePtr LinearSweep::polygon(const Node& node, const Outline& outline,
                              const std::vector<Outline>& holes) const {
  const auto raised = [&](Outline points) {
    for (Vec3& p : points) p.z = base_;
    return points;
  };
  std::vector<Outline> raised_holes;
  for (const Outline& hole : holes) raised_holes.push_back(raised(hole));
  std::optional<PrismTop> top;
  if (twist_ != 0 || scale_ != std::array{1.0, 1.0}) {
    top = PrismTop{{0, 0, base_}, scale_, twist_};
  }
  return make<Prism>(context_, node, raised(outline), raised_holes, Vec3{0, 0, height_}, top);
}

ShapePtr LinearSweep::circle(const Node& node, double radius, const Affine& map) const {
  const auto factor = flat_similarity(map);
  const Vec3 center{map.translation.x, map.translation.y, 0};
  const bool turns_in_itself = factor && center == Vec3{};
  if (scale_[0] != scale_[1] || (twist_ != 0 && !turns_in_itself)) {
    return circle_of_corners(node, radius, map);
  }
  const Vec3 start{0, 0, base_}, along{0, 0, height_};
  const double k = scale_[0];
  const Vec3 drift = center * (k - 1);  // from base to top
  if (factor && drift == Vec3{}) {
    const double r = radius * *factor;
    return make<Frustum>(context_, node, center + start, center + start + along, r, k * r, true);
  }
  const Vec3 x = map.vector({1, 0, 0}), y = map.vector({0, 1, 0});
  Affine slanted;
  slanted.linear = {Vec3{x.x, y.x, drift.x / height_}, Vec3{x.y, y.y, drift.y / height_},
                    Vec3{0, 0, 1}};
  slanted.translation = center + start;
  return placed(context_, node,
                make<Frustum>(context_, node, Vec3{}, along, radius, k * radius, true), slanted);
}

ShapePtr RotarySweep::revolved(const Node& node, const Outline& outline) const {
  std::vector<ProfilePoint> profile;
  for (const Vec3& p : right_half(outline)) {
    const ProfilePoint next{p.x, p.y};
    if (profile.empty() || profile.back() != next) profile.push_back(next);
  }
  while (profile.size() > 1 && profile.front() == profile.back()) profile.pop_back();
  double reach = 0;
  for (const auto& [r, z] : profile) reach = std::max(reach, r);
  if (profile.size() < 3 || reach == 0) return nullptr;
  return make<Revolution>(context_, node, Vec3{}, Vec3{0, 0, 1}, profile,
                          RevolutionForm{.angle = angle_});
}

ShapePtr RotarySweep::polygon(const Node& node, const Outline& outline,
                              const std::vector<Outline>& holes) const {
  std::vector<ShapePtr> solids = {revolved(node, outline)};
  for (const Outline& hole : holes) solids.push_back(revolved(node, hole));
  return combined(context_, node, CsgOperation::subtract, solids);
}

/// What of a solid about z lies within the angle.
ShapePtr RotarySweep::within_angle(const Node& node, ShapePtr solid) const {
  if (angle_ == 360) return solid;
  const Bounds box = solid->bounds();
  const double reach = box.diagonal();
  const ShapePtr wedge = revolved(node, {{0, box.lower.z - reach, 0},
                                         {2 * reach, box.lower.z - reach, 0},
                                         {2 * reach, box.upper.z + reach, 0},
                                         {0, box.upper.z + reach, 0}});
  return combined(context_, node, CsgOperation::intersect, {std::move(solid), wedge});
}

ShapePtr RotarySweep::circle(const Node& node, double radius, const Affine& map) const {
  const auto factor = flat_similarity(map);
  if (!factor) return circle_of_corners(node, radius, map);
  const double r = radius * *factor, major = map.translation.x;
  const Vec3 center{0, 0, map.translation.y};
  if (major == 0) return within_angle(node, make<Sphere>(context_, node, center, r));
  if (major > r) {
    return within_angle(node, make<Torus>(context_, node, center, Vec3{0, 0, 1}, major, r));
  }
  return major <= -r ? nullptr : circle_of_corners(node, radius, map);
}

}  // namespace isolux::openscad
