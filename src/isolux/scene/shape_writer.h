#pragma once

#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "isolux/scene/finish.h"

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
  /// `materials` are their names as the text has them, by number.
  ShapeWriter(const Scene& scene, const std::vector<std::string>& materials);

  /// Appends lines with all shapes that have names, each after those that it is made of.
  void append_shared(std::string& text) const;

  /// Appends a line's end and "shape: ..." of an object, or of one that is split by finish, in as
  /// many lines as that takes.
  void append(std::string& text, std::size_t indent, std::span<const Object> object) const;

 private:
  struct Node;
  using Uses = std::unordered_map<const Shape*, std::size_t>;

  /// Adds the shape and all that it is made of to `order_`, what is inside first.
  void collect(const std::shared_ptr<const Shape>& shape, Uses& uses);
  /// The same for the parts of a shape that have one finish throughout, from that face on.
  void collect(const std::shared_ptr<const Shape>& shape, const FinishOfFaces& finishes,
               std::uint32_t face, Uses& uses);
  /// The shape with all that it is made of, up to what has a name.
  Node described(const std::shared_ptr<const Shape>& shape) const;
  /// The same with the finishes of its parts, from that face on.
  Node described(const std::shared_ptr<const Shape>& shape, const FinishOfFaces& finishes,
                 std::uint32_t face) const;
  /// The same for a shape that is no instance, even where it has a name itself.
  Node written_out(const Shape& shape) const;
  static void append(std::string& text, std::size_t indent, const std::string& key,
                     const Node& node);

  const std::vector<std::string>& materials_;
  std::vector<std::shared_ptr<const Shape>> order_;  ///< with names
  std::unordered_map<const Shape*, std::string> names_;
};

}  // namespace isolux
