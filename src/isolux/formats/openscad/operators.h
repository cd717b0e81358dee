#pragma once

#include <span>

#include "isolux/formats/openscad/make.h"

namespace isolux::openscad {

/// What a node does to its children.
struct Operator {
  bool map = false;                       ///< moves them: a multmatrix
  std::optional<CsgOperation> operation;  ///< nothing for what merely lists them
  std::span<const Node> operands;         ///< its children, or those that count
};

/// The operator that a node is; what can't be kept of it goes to the notes. An unknown node is an
/// error.
Operator operator_of(const Context& context, const Node& node);

/// Whether the node is one that makes nothing here, such as text; if so it goes to the notes.
bool is_left_out(const Context& context, const Node& node);

/// The map of a multmatrix (m); nothing, and a note, for one that flattens.
std::optional<Affine> map_of(const Context& context, const Node& node);

/// Fails where solids are nested deeper than scenes can be.
void require_shallow(const Context& context, const Node& node, int depth);

}  // namespace isolux::openscad
