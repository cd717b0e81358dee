#pragma once

#include "isolux/formats/openscad/make.h"

namespace isolux::openscad {

using Outline = std::vector<Vec3>;  ///< in the plane z = 0, m

/// How an extrusion makes flat things solid.
class Sweep {
 public:
  virtual ~Sweep() = default;
  /// Of a polygon with holes.
  virtual ShapePtr polygon(const Node& node, const Outline& outline,
                           const std::vector<Outline>& holes) const = 0;
  /// Of a circle about the origin, seen through the map.
  virtual ShapePtr circle(const Node& node, double radius, const Affine& map) const = 0;

 protected:
  explicit Sweep(const Context& context) : context_(context) {}
  /// Of a circle as a polygon, where its solid has no form of its own.
  ShapePtr circle_of_corners(const Node& node, double radius, const Affine& map) const;

  const Context& context_;
};

/// Along z.
class LinearSweep final : public Sweep {
 public:
  /// Reads the arguments of a linear_extrude.
  LinearSweep(const Context& context, const Node& node);
  /// Whether there is a height.
  bool has_volume() const { return height_ > 0; }
  ShapePtr polygon(const Node& node, const Outline& outline,
                   const std::vector<Outline>& holes) const override;
  ShapePtr circle(const Node& node, double radius, const Affine& map) const override;

 private:
  double height_, base_;  ///< m
  std::array<double, 2> scale_ = {1, 1};
  double twist_;  ///< degrees, right-handed
};

/// About z, x becoming the distance from it, y the height. What lies at x < 0 is cut off.
class RotarySweep final : public Sweep {
 public:
  /// `angle` in degrees, more than 0.
  RotarySweep(const Context& context, double angle) : Sweep(context), angle_(angle) {}
  ShapePtr polygon(const Node& node, const Outline& outline,
                   const std::vector<Outline>& holes) const override;
  ShapePtr circle(const Node& node, double radius, const Affine& map) const override;

 private:
  ShapePtr within_angle(const Node& node, ShapePtr solid) const;
  ShapePtr revolved(const Node& node, const Outline& outline) const;

  double angle_;
};

}  // namespace isolux::openscad
