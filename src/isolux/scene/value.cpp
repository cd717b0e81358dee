#include "isolux/scene/value.h"

#include <fmt/format.h>

#include <cmath>

#include "isolux/scene/length.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace {

// Far outside what rooms need, yet products of a few of them stay exact enough.
constexpr double kLargestLength = 1e9;    ///< m
constexpr double kSmallestLength = 1e-9;  ///< m, of sizes

std::optional<Vec3> named_axis(std::string_view name) {
  const double sign = name.starts_with('-') ? -1 : 1;
  if (name.starts_with('-') || name.starts_with('+')) name.remove_prefix(1);
  if (name == "x") return Vec3{sign, 0, 0};
  if (name == "y") return Vec3{0, sign, 0};
  if (name == "z") return Vec3{0, 0, sign};
  return std::nullopt;
}

}  // namespace

void Value::fail(const std::string& message) const { throw InputError(location(), message); }

std::string Value::described() const {
  switch (node_->kind) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::list:
      return "a list";
    case YamlNode::Kind::map:
      return "a map of keys";
    case YamlNode::Kind::scalar:
      break;
  }
  if (node_->quoted && parse_number(node_->text)) return "text in quotes";
  return in_quotes(node_->text);
}

bool Value::is_text() const {
  return node_->kind == YamlNode::Kind::scalar && (node_->quoted || !parse_number(node_->text));
}

double Value::finite(double number) const {
  if (!std::isfinite(number)) {
    fail(fmt::format("{} must be a finite number, not {}", in_quotes(label_), described()));
  }
  return number;
}

double Value::number() const {
  std::optional<double> parsed;
  if (node_->kind == YamlNode::Kind::scalar && !node_->quoted) parsed = parse_number(node_->text);
  if (!parsed) fail(fmt::format("{} must be a number, not {}", in_quotes(label_), described()));
  return finite(*parsed);
}

double Value::length() const {
  std::optional<NumberWithUnit> parsed;
  if (node_->kind == YamlNode::Kind::scalar) parsed = split_unit(node_->text);
  if (!parsed || (node_->quoted && parsed->unit.empty())) {
    fail(fmt::format("{} must be a length such as 0.3 or 30 cm, not {}", in_quotes(label_),
                     described()));
  }
  double metres = context_->metres_per_unit;
  if (!parsed->unit.empty()) {
    const std::optional<double> known = metres_per(parsed->unit);
    if (!known) {
      fail(fmt::format("unknown unit {} of length: {}", in_quotes(parsed->unit),
                       suggestion(parsed->unit, length_units())));
    }
    metres = *known;
  }
  const double length = finite(parsed->number) * metres;
  if (std::abs(length) > kLargestLength) {
    fail(fmt::format("{} must be within 1e9 m, not {}: check the unit", in_quotes(label_),
                     described()));
  }
  return length;
}

double Value::positive_length() const {
  const double size = length();
  if (!(size > 0)) {
    fail(fmt::format("{} must be more than 0, not {}", in_quotes(label_), described()));
  }
  if (size < kSmallestLength) {
    fail(fmt::format("{} must be at least 1e-9 m, not {}: check the unit", in_quotes(label_),
                     described()));
  }
  return size;
}

int Value::integer(int least, int most) const {
  const double value = number();
  if (value != std::floor(value) || value < least || value > most) {
    fail(fmt::format("{} must be a whole number from {} to {}, not {}", in_quotes(label_), least,
                     most, described()));
  }
  return static_cast<int>(value);
}

bool Value::flag() const {
  if (node_->kind == YamlNode::Kind::scalar && !node_->quoted) {
    if (node_->text == "true") return true;
    if (node_->text == "false") return false;
  }
  fail(fmt::format("{} must be true or false, not {}", in_quotes(label_), described()));
}

std::string Value::text() const {
  if (node_->kind != YamlNode::Kind::scalar || node_->text.empty()) {
    fail(fmt::format("{} must be a text, not {}", in_quotes(label_),
                     node_->kind == YamlNode::Kind::scalar ? "an empty one" : described()));
  }
  return std::string(node_->text);
}

std::size_t Value::choice(const std::vector<std::string_view>& words) const {
  const std::string word = text();
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == word) return i;
  }
  fail(fmt::format("unknown {} {}: {}", label_, in_quotes(word), suggestion(word, words)));
}

Vec3 Value::point() const {
  const std::vector<Value> parts = items(3, 3);
  return {parts[0].length(), parts[1].length(), parts[2].length()};
}

Vec3 Value::vector() const {
  const std::vector<Value> parts = items(3, 3);
  return {parts[0].number(), parts[1].number(), parts[2].number()};
}

Vec3 Value::direction() const {
  if (node_->kind == YamlNode::Kind::scalar) {
    if (const auto axis = named_axis(node_->text)) return *axis;
    fail(fmt::format("{} must be a direction such as z, -x or [0, 1, 1], not {}", in_quotes(label_),
                     described()));
  }
  const Vec3 given = vector();
  const double largest = std::max({std::abs(given.x), std::abs(given.y), std::abs(given.z)});
  if (!(largest > 0)) {
    fail(fmt::format("{} must not be [0, 0, 0]: give the direction it points to",
                     in_quotes(label_)));
  }
  if (is_unit(given)) return given;
  // Divided first, so that neither huge nor tiny numbers leave the range in between.
  return normalized(Vec3{given.x / largest, given.y / largest, given.z / largest});
}

Rgb Value::color() const {
  Rgb color;
  if (is_list()) {
    const Vec3 channels = vector();
    color = {channels.x, channels.y, channels.z};
  } else if (node_->kind == YamlNode::Kind::scalar) {
    color = gray(number());
  } else {
    fail(fmt::format("{} must be a number or a list [red, green, blue], not {}", in_quotes(label_),
                     described()));
  }
  if (min_channel(color) < 0) fail(fmt::format("{} must not be negative", in_quotes(label_)));
  return color;
}

std::vector<Value> Value::items(std::size_t least, std::size_t most) const {
  if (!is_list()) {
    const std::string wanted = least == most && most > 0 ? fmt::format(" of {}", most) : "";
    fail(fmt::format("{} must be a list{}, not {}", in_quotes(label_), wanted, described()));
  }
  const std::size_t size = node_->children.size();
  if (size < least || (most > 0 && size > most)) {
    const std::string_view bound = least == most ? "" : size < least ? "at least " : "at most ";
    fail(fmt::format("{} must be a list of {}{}, not of {}", in_quotes(label_), bound,
                     size < least ? least : most, size));
  }
  std::vector<Value> list;
  list.reserve(size);
  for (const YamlNode* child : node_->children) list.emplace_back(*context_, *child, label_);
  return list;
}

std::vector<std::pair<Value, Value>> Value::entries() const {
  if (!is_map()) {
    fail(fmt::format("{} must be a map of keys, not {}", in_quotes(label_), described()));
  }
  std::vector<std::pair<Value, Value>> list;
  for (std::size_t i = 0; i + 1 < node_->children.size(); i += 2) {
    const YamlNode& key = *node_->children[i];
    list.emplace_back(Value(*context_, key, key.text),
                      Value(*context_, *node_->children[i + 1], key.text));
  }
  return list;
}

std::optional<Value> Value::find(std::string_view key) const {
  for (const auto& [name, value] : entries()) {
    if (name.label() == key) return value;
  }
  return std::nullopt;
}

Fields::Fields(const Value& map, const std::vector<std::string_view>& known) : map_(map) {
  for (const auto& [key, value] : map.entries()) {
    if (std::find(known.begin(), known.end(), key.label()) == known.end()) {
      key.fail(fmt::format("unknown key {} in {}: {}", in_quotes(key.label()),
                           in_quotes(map.label()), suggestion(key.label(), known)));
    }
  }
}

Value Fields::require(std::string_view key) const {
  if (const std::optional<Value> value = find(key)) return *value;
  map_.fail(fmt::format("{} lacks the key {}: add it", in_quotes(map_.label()), in_quotes(key)));
}

}  // namespace isolux
