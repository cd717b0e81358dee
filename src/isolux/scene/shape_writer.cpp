#include "isolux/scene/shape_writer.h"

#include <fmt/format.h>

#include "isolux/geometry/instance.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/scene/yaml_text.h"

namespace isolux {
namespace {

constexpr std::size_t kMostOnALine = 32;  ///< numbers
constexpr std::size_t kPlacement = 12;    ///< numbers: what it takes to say where a shape stands

using Entries = std::vector<std::pair<std::string, std::string>>;

void new_line(std::string& text, std::size_t indent) {
  text += '\n';
  text.append(indent, ' ');
}

// How many numbers a value has, and the value within a line.

std::size_t size_of(bool) { return 1; }
std::size_t size_of(double) { return 1; }
std::size_t size_of(std::string_view) { return 1; }
std::size_t size_of(const Vec3&) { return 3; }
std::size_t size_of(const std::vector<double>& list) { return list.size(); }
std::size_t size_of(const std::vector<Vec3>& list) { return 3 * list.size(); }
std::size_t size_of(const ShapeDescription::Triangles& list) { return 3 * list.size(); }
std::size_t size_of(const ShapeDescription::Outlines& outlines) {
  std::size_t size = 0;
  for (const auto& outline : outlines) size += size_of(outline);
  return size;
}
std::size_t size_of(const ShapeDescription::Rows& rows) {
  std::size_t size = 0;
  for (const auto& row : rows) size += row.size();
  return size;
}
std::size_t size_of(const ShapeDescription::Record& record);
std::size_t size_of(const std::vector<ShapeDescription::Record>& records) {
  std::size_t size = 0;
  for (const auto& record : records) size += size_of(record);
  return size;
}
std::size_t size_of(const ShapeDescription::Value& value) {
  return std::visit([](const auto& v) { return size_of(v); }, value);
}
std::size_t size_of(const ShapeDescription::Record& record) {
  std::size_t size = 0;
  for (const auto& field : record) size += size_of(field.value);
  return size;
}

std::string triangle(const std::array<std::uint32_t, 3>& t) {
  return fmt::format("[{}, {}, {}]", t[0], t[1], t[2]);
}

std::string flow(bool flag) { return flag ? "true" : "false"; }
std::string flow(double number) { return to_yaml(number); }
std::string flow(std::string_view text) { return to_yaml(text); }
std::string flow(const Vec3& v) { return to_yaml(v); }
std::string flow(const std::vector<double>& list) { return to_yaml_list(list); }
std::string flow(const std::vector<Vec3>& list) { return to_yaml_list(list); }
std::string flow(const ShapeDescription::Triangles& list) {
  std::string text = "[";
  for (const auto& t : list) text += (text.size() > 1 ? ", " : "") + triangle(t);
  return text + "]";
}

/// The rows of the map, with the translation as last column.
std::array<std::string, 3> rows_of(const Affine& map) {
  std::array<std::string, 3> rows;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& row = map.linear[i];
    rows[i] = to_yaml_list(std::array{row.x, row.y, row.z, map.translation[static_cast<int>(i)]});
  }
  return rows;
}

/// "[[1, 2], [3]]"
template <typename Item>
std::string flow(const std::vector<std::vector<Item>>& lists) {
  std::string text = "[";
  for (const auto& list : lists) text += (text.size() > 1 ? ", " : "") + flow(list);
  return text + "]";
}

std::string flow(const Affine& map) {
  if (map.linear == Affine{}.linear) return "[{translate: " + to_yaml(map.translation) + "}]";
  const auto [x, y, z] = rows_of(map);
  return fmt::format("[{{matrix: [{}, {}, {}]}}]", x, y, z);
}

std::string flow(const ShapeDescription::Record& record);
std::string flow(const std::vector<ShapeDescription::Record>& records) {
  std::string text = "[";
  for (const auto& record : records) text += (text.size() > 1 ? ", " : "") + flow(record);
  return text + "]";
}
std::string flow(const ShapeDescription::Value& value) {
  return std::visit([](const auto& v) { return flow(v); }, value);
}
std::string flow(const ShapeDescription::Record& record) {
  Entries entries;
  for (const auto& [key, value] : record) entries.emplace_back(key, flow(value));
  return flow_map(entries);
}

template <typename Item>
void append_items(std::string& text, const std::vector<Item>& items, std::size_t indent) {
  for (const Item& item : items) {
    new_line(text, indent);
    text += "- ";
    if constexpr (std::is_same_v<Item, std::array<std::uint32_t, 3>>) {
      text += triangle(item);
    } else if constexpr (requires { item.begin(); }) {
      text += flow(item);
    } else {
      text += to_yaml(item);
    }
  }
}

void append_field(std::string& text, const ShapeDescription::Field& field, std::size_t indent) {
  new_line(text, indent);
  text += field.key;
  text += ':';
  if (size_of(field.value) <= kMostOnALine) {
    const std::string line = flow(field.value);
    if (indent + field.key.size() + line.size() + 2 <= kLineWidth) {
      text += ' ' + line;
      return;
    }
  }
  std::visit(
      [&](const auto& value) {
        if constexpr (requires { append_items(text, value, indent); }) {
          append_items(text, value, indent + 2);
        } else {
          text += ' ' + flow(value);
        }
      },
      field.value);
}

void append_transform(std::string& text, const Affine& map, std::size_t indent) {
  new_line(text, indent);
  text += "transform:";
  const std::string line = flow(map);
  if (indent + line.size() + 11 <= kLineWidth) {
    text += ' ' + line;
    return;
  }
  new_line(text, indent + 2);
  text += "- matrix:";
  for (const std::string& row : rows_of(map)) {
    new_line(text, indent + 6);
    text += "- " + row;
  }
}

}  // namespace

bool is_worth_a_name(const Shape& shape) {
  const ShapeDescription description = shape.describe();
  const auto& operands = description.operands;
  return size_of(description.fields) > kPlacement || operands.size() > 1 ||
         (operands.size() == 1 && is_worth_a_name(*operands.front()));
}

/// A shape, and the shapes that it is made of.
struct ShapeWriter::Node {
  ShapeDescription shape;
  std::vector<Node> operands;
  std::string instance;  ///< the name of a shape that is written elsewhere; or empty
  Entries finish;        ///< `material` and `emission`, where they are its own

  /// Numbers, and names.
  std::size_t size() const {
    std::size_t size = (shape.transform ? kPlacement : 0) + size_of(shape.fields);
    for (const Node& operand : operands) size += operand.size();
    return instance.empty() ? size : size + 1;
  }

  /// What stands under the shape's key; a single operand without a list.
  std::string flow_content() const {
    if (!instance.empty()) return instance;
    if (operands.size() == 1) return operands.front().flow();
    if (operands.empty()) return isolux::flow(shape.fields);
    std::string list = "[";
    for (const Node& operand : operands) list += (list.size() > 1 ? ", " : "") + operand.flow();
    return list + "]";
  }

  std::string flow() const {
    Entries entries{{std::string(shape.kind), flow_content()}};
    if (shape.transform) entries.emplace_back("transform", isolux::flow(*shape.transform));
    entries.insert(entries.end(), finish.begin(), finish.end());
    return flow_map(entries);
  }

  /// Appends the entries of a map in lines of that indent; the first is begun already.
  void append_block(std::string& text, std::size_t indent) const {
    text += shape.kind;
    text += ':';
    const bool may_fit = size() <= kMostOnALine;
    const std::string content = may_fit ? flow_content() : "";
    const bool fits = may_fit && indent + shape.kind.size() + 2 + content.size() <= kLineWidth;
    if (fits || !instance.empty()) {
      text += ' ' + content;
    } else {
      for (const auto& field : shape.fields) append_field(text, field, indent + 2);
      const bool listed = operands.size() > 1;
      for (const Node& operand : operands) {
        new_line(text, indent + 2);
        if (listed) text += "- ";
        operand.append_block(text, indent + (listed ? 4 : 2));
      }
    }
    if (shape.transform) append_transform(text, *shape.transform, indent);
    for (const auto& [key, value] : finish) {
      new_line(text, indent);
      text += key + ": " + value;
    }
  }
};

std::string flow_map(const Entries& entries) {
  std::string map = "{";
  for (const auto& [key, value] : entries) {
    if (map.size() > 1) map += ", ";
    map += key + ": " + value;
  }
  return map + "}";
}

ShapeWriter::ShapeWriter(const Scene& scene, const std::vector<std::string>& materials)
    : materials_(materials) {
  Uses uses;
  const std::span<const Object> objects(scene.objects);
  for (std::size_t i = 0, n = 0; i < objects.size(); i += n) {
    n = count_split(scene.objects, i);
    if (n == 1) {
      collect(objects[i].shape, uses);
    } else {
      const FinishOfFaces finishes(objects.subspan(i, n));
      collect(finishes.whole(), finishes, 0, uses);
    }
  }
  std::vector<std::shared_ptr<const Shape>> named;
  for (std::shared_ptr<const Shape>& shape : order_) {
    if (uses[shape.get()] == 1) continue;
    const Node node = written_out(*shape);
    if (node.size() <= kPlacement && node.operands.size() < 2) continue;
    named.push_back(std::move(shape));
    names_[named.back().get()] = fmt::format("{} {}", node.shape.kind, named.size());
  }
  order_ = std::move(named);
}

void ShapeWriter::collect(const std::shared_ptr<const Shape>& shape, Uses& uses) {
  const std::shared_ptr<const Shape> first = original(shape).shape;
  if (++uses[first.get()] > 1) return;
  for (const auto& operand : first->describe().operands) collect(operand, uses);
  order_.push_back(first);
}

void ShapeWriter::collect(const std::shared_ptr<const Shape>& shape, const FinishOfFaces& finishes,
                          std::uint32_t face, Uses& uses) {
  if (finishes.all(face, shape->face_count())) return collect(shape, uses);
  for (const auto& operand : original(shape).shape->describe().operands) {
    collect(operand, finishes, face, uses);
    face += operand->face_count();
  }
}

ShapeWriter::Node ShapeWriter::written_out(const Shape& shape) const {
  Node node{shape.describe(), {}, {}, {}};
  for (const auto& operand : node.shape.operands) node.operands.push_back(described(operand));
  return node;
}

ShapeWriter::Node ShapeWriter::described(const std::shared_ptr<const Shape>& shape) const {
  const Original found = original(shape);
  Node node;
  if (const auto name = names_.find(found.shape.get()); name != names_.end()) {
    node.shape.kind = "instance";
    node.instance = name->second;
  } else {
    node = written_out(*found.shape);
  }
  if (found.map) {
    const std::optional<Affine>& inner = node.shape.transform;
    node.shape.transform = inner ? *found.map * *inner : *found.map;
  }
  return node;
}

ShapeWriter::Node ShapeWriter::described(const std::shared_ptr<const Shape>& shape,
                                         const FinishOfFaces& finishes, std::uint32_t face) const {
  if (const auto finish = finishes.all(face, shape->face_count())) {
    Node node = described(shape);
    if (finish == finishes.own()) return node;
    node.finish.emplace_back("material", materials_[finish->material]);
    if (finish->exitance != Rgb{}) {
      node.finish.emplace_back("emission", "{exitance: " + to_yaml(finish->exitance) + "}");
    }
    return node;
  }
  Node node{shape->describe(), {}, {}, {}};
  for (const auto& operand : node.shape.operands) {
    node.operands.push_back(described(operand, finishes, face));
    face += operand->face_count();
  }
  return node;
}

void ShapeWriter::append(std::string& text, std::size_t indent, const std::string& key,
                         const Node& node) {
  new_line(text, indent);
  text += key + ':';
  if (node.size() <= kMostOnALine) {
    const std::string line = node.flow();
    if (indent + key.size() + 2 + line.size() <= kLineWidth) {
      text += ' ' + line;
      return;
    }
  }
  new_line(text, indent + 2);
  node.append_block(text, indent + 2);
}

void ShapeWriter::append(std::string& text, std::size_t indent,
                         std::span<const Object> object) const {
  if (object.size() == 1) return append(text, indent, "shape", described(object.front().shape));
  const FinishOfFaces finishes(object);
  append(text, indent, "shape", described(finishes.whole(), finishes, 0));
}

void ShapeWriter::append_shared(std::string& text) const {
  if (order_.empty()) return;
  text += "\nshapes:";
  for (const auto& shape : order_) append(text, 2, names_.at(shape.get()), written_out(*shape));
  text += '\n';
}

}  // namespace isolux
