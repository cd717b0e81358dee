#pragma once

#include "isolux/core/affine.h"
#include "isolux/formats/openscad/tree.h"

namespace isolux::openscad {

/// The arguments of one node, read as what they should be: anything else is an error with its
/// place. Lengths are in the units of the file; all lie within ± 10⁹.
class Arguments {
 public:
  Arguments(const Tree& tree, const Node& node) : tree_(tree), node_(node) {}

  double number(std::string_view name, double otherwise) const;
  double number(std::string_view name) const;
  bool flag(std::string_view name) const;
  /// Two or three numbers: a list of as many at least, or one number for all.
  std::vector<double> numbers(std::string_view name, std::size_t count) const;
  /// A list of points of `dimension` coordinates, the others 0.
  std::vector<Vec3> points(std::string_view name, std::size_t dimension) const;
  /// Lists of places in a list of that size; empty where the argument is undef or not there.
  std::vector<std::vector<std::uint32_t>> places(std::string_view name, std::size_t size) const;
  /// The matrix of a multmatrix.
  Affine matrix() const;
  /// The color of a `color`: red, green, blue, opacity, from 0 to 1.
  std::array<double, 4> color() const;

 private:
  double number(const Literal& value, std::string_view what) const;
  const Literal::List& list(const Literal& value, std::string_view what, std::size_t least) const;
  const Literal* given(std::string_view name) const;
  const Literal& required(std::string_view name) const;

  const Tree& tree_;
  const Node& node_;
};

}  // namespace isolux::openscad
