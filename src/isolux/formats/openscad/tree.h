#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "isolux/core/error.h"

namespace isolux::openscad {

/// Where something stands in the file; both count from 1.
struct Place {
  int line = 1;
  int column = 1;
};

/// A value as OpenSCAD writes it; std::monostate is undef.
struct Literal {
  using List = std::vector<Literal>;
  std::variant<std::monostate, bool, double, std::string, List> content;
  Place place;

  const double* number() const { return std::get_if<double>(&content); }
  const List* list() const { return std::get_if<List>(&content); }
};

/// What a parameter is given: name and value; those without a name have an empty one.
struct Argument {
  std::string_view name;
  Literal value;
};

/// A node of the tree that OpenSCAD exports: `cube(size = 3);`, `union() { ... }`.
struct Node {
  std::string_view name;  ///< in the text that was parsed
  Place place;
  std::vector<Argument> arguments;
  std::vector<Node> children;

  const Literal* find(std::string_view argument) const;
};

/// The file's nodes.
struct Tree {
  std::string file;
  std::vector<Node> nodes;

  [[noreturn]] void fail(const Place& place, const std::string& message) const {
    throw InputError({file, place.line, place.column}, message);
  }
};

/// Parses the text of a .csg file, which must outlive the tree. Nodes marked with % (background)
/// are left out. Throws InputError with line and column where the text is no such tree, nests more
/// than 200 deep or has more than 10⁶ nodes or 8 · 10⁶ values.
Tree parse(std::string_view text, std::string file);

}  // namespace isolux::openscad
