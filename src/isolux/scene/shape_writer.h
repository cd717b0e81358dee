#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "isolux/scene/scene.h"

namespace isolux {

inline constexpr std::size_t kLineWidth = 100;  ///< bytes, where a line can be broken

/// "{a: 1, b: 2}"
std::string flow_map(const std::vector<std::pair<std::string, std::string>>& entries);

/// Whether a shape takes more room than it takes to say where it stands.
bool is_worth_a_name(const Shape& shape);

/// Writes the shapes of a scene in the native format. Those that stand in several places, and take
/// more room than it takes to say where, have names and are written once.
class ShapeWriter {
 public:
  explicit ShapeWriter(const Scene& scene);

  /// Appends lines with all shapes that have names, each after those that it is made of.
  void append_shared(std::string& text) const;

  /// Appends a line's end and "key: shape", in as many lines as that takes.
  void append(std::string& text, std::size_t indent, const std::string& key,
              const std::shared_ptr<const Shape>& shape) const;

 private:
  struct Node;

  /// Adds the shape and all that it is made of to `order_`, what is inside first.
  void collect(const std::shared_ptr<const Shape>& shape,
               std::unordered_map<const Shape*, std::size_t>& uses);
  /// The shape with all that it is made of, up to what has a name.
  Node described(const std::shared_ptr<const Shape>& shape) const;
  /// The same for a shape that is no instance, even where it has a name itself.
  Node written_out(const Shape& shape) const;
  static void append(std::string& text, std::size_t indent, const std::string& key,
                     const Node& node);

  std::vector<std::shared_ptr<const Shape>> order_;  ///< with names
  std::unordered_map<const Shape*, std::string> names_;
};

}  // namespace isolux
