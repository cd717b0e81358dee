#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/core/error.h"
#include "isolux/core/vec3.h"
#include "isolux/scene/piece_count.h"
#include "isolux/scene/yaml.h"

namespace isolux {

/// What a value of a scene file is read against.
struct ReadingContext {
  std::string file;
  double metres_per_unit = 1;      ///< what plain lengths count in
  mutable PieceCount pieces = {};  ///< of the shapes read so far
};

/// One value of a scene file, read strictly: whatever is not as asked for ends in an InputError
/// with the value's place. Lengths come out in metres, all numbers finite.
class Value {
 public:
  /// `label` is what messages call it: its key, and for an item of a list that of the list.
  Value(const ReadingContext& context, const YamlNode& node, std::string_view label)
      : context_(&context), node_(&node), label_(label) {}

  std::string_view label() const { return label_; }
  Value labelled(std::string_view label) const { return {*context_, *node_, label}; }
  /// Those of the scene that is read.
  PieceCount& pieces() const { return context_->pieces; }
  SourceLocation location() const { return {context_->file, node_->line, node_->column}; }
  [[noreturn]] void fail(const std::string& message) const;

  bool is_text() const;  ///< a scalar that is no number
  bool is_list() const { return node_->kind == YamlNode::Kind::list; }
  bool is_map() const { return node_->kind == YamlNode::Kind::map; }

  double number() const;
  double length() const;           ///< a number, or text with a unit; m
  double positive_length() const;  ///< more than 0, m
  int integer(int least, int most) const;
  bool flag() const;
  std::string text() const;  ///< not empty
  /// One of the words, by its place in the list.
  std::size_t choice(const std::vector<std::string_view>& words) const;

  Vec3 point() const;      ///< a list of three lengths, m
  Vec3 vector() const;     ///< a list of three numbers
  Vec3 direction() const;  ///< a vector that is not zero, or an axis such as z or -x
  Rgb color() const;       ///< a number ≥ 0 for all three channels, or a list of three

  /// The items of a list of at least `least`, at most `most` (0: any number).
  std::vector<Value> items(std::size_t least = 0, std::size_t most = 0) const;
  /// The entries of a map in the order of the file: key and value, labelled by its key.
  std::vector<std::pair<Value, Value>> entries() const;
  /// The entry of a map under that key.
  std::optional<Value> find(std::string_view key) const;

 private:
  std::string described() const;
  double finite(double number) const;

  const ReadingContext* context_;
  const YamlNode* node_;
  std::string_view label_;
};

/// A map whose keys are known: an unknown one is an error that names the nearest known.
class Fields {
 public:
  Fields(const Value& map, const std::vector<std::string_view>& known);

  std::optional<Value> find(std::string_view key) const { return map_.find(key); }
  Value require(std::string_view key) const;

 private:
  Value map_;
};

}  // namespace isolux
