#include "isolux/scene/writer.h"

#include <fmt/format.h>

#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "isolux/geometry/shape_description.h"
#include "isolux/scene/yaml_text.h"

namespace isolux {
namespace {

constexpr std::size_t kLineWidth = 100;      ///< bytes, where a line can be broken
constexpr std::size_t kMostOnALine = 32;     ///< numbers
constexpr std::size_t kLongestName = 200;    ///< bytes of a key; YAML ends at 1024 characters
constexpr std::size_t kShortenedName = 180;  ///< bytes, to leave room for a number

using Entries = std::vector<std::pair<std::string, std::string>>;

/// "{a: 1, b: 2}"
std::string flow_map(const Entries& entries) {
  std::string map = "{";
  for (const auto& [key, value] : entries) {
    if (map.size() > 1) map += ", ";
    map += key + ": " + value;
  }
  return map + "}";
}

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

std::size_t size_of(const ShapeDescription& shape) {
  std::size_t size = (shape.transform ? 12 : 0) + size_of(shape.fields);
  for (const ShapeDescription& operand : shape.operands) size += size_of(operand);
  return size;
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

std::string flow(const ShapeDescription& shape);

/// What stands under the shape's key; a single operand without a list.
std::string flow_content(const ShapeDescription& shape) {
  if (shape.operands.size() == 1) return flow(shape.operands.front());
  if (!shape.operands.empty()) {
    std::string list = "[";
    for (const auto& operand : shape.operands)
      list += (list.size() > 1 ? ", " : "") + flow(operand);
    return list + "]";
  }
  return flow(shape.fields);
}

std::string flow(const ShapeDescription& shape) {
  Entries entries{{std::string(shape.kind), flow_content(shape)}};
  if (shape.transform) entries.emplace_back("transform", flow(*shape.transform));
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

/// The shape as the entries of a map in lines of that indent; the first is begun already.
void append_block(std::string& text, const ShapeDescription& shape, std::size_t indent) {
  text += shape.kind;
  text += ':';
  const bool may_fit = size_of(shape) <= kMostOnALine;
  const std::string content = may_fit ? flow_content(shape) : "";
  if (may_fit && indent + shape.kind.size() + 2 + content.size() <= kLineWidth) {
    text += ' ' + content;
  } else {
    for (const auto& field : shape.fields) append_field(text, field, indent + 2);
    const bool listed = shape.operands.size() > 1;
    for (const ShapeDescription& operand : shape.operands) {
      new_line(text, indent + 2);
      if (listed) text += "- ";
      append_block(text, operand, indent + (listed ? 4 : 2));
    }
  }
  if (shape.transform) append_transform(text, *shape.transform, indent);
}

void append_shape(std::string& text, const ShapeDescription& shape, std::size_t indent) {
  new_line(text, indent);
  text += "shape:";
  if (size_of(shape) <= kMostOnALine) {
    const std::string line = flow(shape);
    if (indent + line.size() + 7 <= kLineWidth) {
      text += ' ' + line;
      return;
    }
  }
  new_line(text, indent + 2);
  append_block(text, shape, indent + 2);
}

std::string shortened(const std::string& name) {
  std::size_t size = kShortenedName;
  while (size > 0 && (name[size] & 0xc0) == 0x80) --size;  // not within a UTF-8 sequence
  return name.substr(0, size);
}

/// The name of each as the key of a map: not empty, not too long, each but once.
template <typename Named>
std::vector<std::string> keys_of(const std::vector<Named>& all, const std::string& fallback) {
  std::vector<std::string> keys;
  std::unordered_set<std::string> taken;
  std::unordered_map<std::string, std::size_t> last;
  for (const Named& each : all) {
    std::string name = each.name.empty() ? fallback : each.name;
    if (name.size() > kLongestName) name = shortened(name);
    std::string key = to_yaml(name);
    while (!taken.insert(key).second) {
      std::size_t& number = last.try_emplace(name, 1).first->second;
      key = to_yaml(fmt::format("{} {}", name, ++number));
    }
    keys.push_back(std::move(key));
  }
  return keys;
}

void append_object(std::string& text, const Object& object, std::size_t number,
                   const std::string& material) {
  const ShapeDescription shape = object.shape->describe();
  const std::string name =
      object.name.empty() ? fmt::format("{} {}", shape.kind, number) : object.name;
  text += "  - name: " + to_yaml(name);
  append_shape(text, shape, 4);
  text += "\n    material: " + material;
  if (object.sides == Sides::front && !object.shape->solid()) text += "\n    sides: front";
  if (object.emits()) text += "\n    emission: {exitance: " + to_yaml(object.exitance) + "}";
  text += '\n';
}

void append_source(std::string& text, const Source& source) {
  Entries entries;
  std::string_view kind = "point";
  if (source.kind == Source::Kind::directional) {
    kind = "directional";
    entries = {{"direction", to_yaml(source.direction)},
               {"illuminance", to_yaml(source.intensity)}};
  } else {
    entries.emplace_back("position", to_yaml(source.position));
    if (source.dark_angle < 180) {
      kind = "spot";
      entries.emplace_back("direction", to_yaml(source.direction));
      entries.emplace_back("angles",
                           to_yaml_list(std::array{source.full_angle, source.dark_angle}));
    }
    entries.emplace_back("intensity", to_yaml(source.intensity));
  }
  text += "  - ";
  if (!source.name.empty()) text += "name: " + to_yaml(source.name) + "\n    ";
  fmt::format_to(std::back_inserter(text), "{}: {}\n", kind, flow_map(entries));
}

void append_camera(std::string& text, const Camera& camera, const std::string& key) {
  Entries entries{{"eye", to_yaml(camera.eye)}, {"look_at", to_yaml(camera.look_at)}};
  if (camera.up != Camera{}.up) entries.emplace_back("up", to_yaml(unit_vector(camera.up)));
  entries.emplace_back("fov", to_yaml(camera.fov));
  entries.emplace_back("size", fmt::format("[{}, {}]", camera.width, camera.height));
  text += "  " + key + ":";
  const std::string line = flow_map(entries);
  if (key.size() + line.size() + 4 <= kLineWidth) {
    text += ' ' + line + '\n';
    return;
  }
  for (const auto& [name, value] : entries) text += "\n    " + name + ": " + value;
  text += '\n';
}

}  // namespace

std::string write_scene(const Scene& scene) {
  std::string text = "isolux: 1\n";
  if (!scene.name.empty()) text += "name: " + to_yaml(scene.name) + '\n';

  const std::vector<std::string> materials = keys_of(scene.materials, "material");
  text += "\nmaterials:\n";
  for (std::size_t i = 0; i < materials.size(); ++i) {
    text +=
        "  " + materials[i] + ": {reflectance: " + to_yaml(scene.materials[i].reflectance) + "}\n";
  }

  text += "\nobjects:\n";
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    append_object(text, scene.objects[i], i + 1, materials[scene.objects[i].material]);
  }

  if (!scene.sources.empty()) text += "\nlights:\n";
  for (const Source& source : scene.sources) append_source(text, source);

  if (!scene.cameras.empty()) text += "\ncameras:\n";
  const std::vector<std::string> cameras = keys_of(scene.cameras, "camera");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    append_camera(text, scene.cameras[i], cameras[i]);
  }
  return text;
}

}  // namespace isolux
