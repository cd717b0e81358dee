#include "isolux/scene/writer.h"

#include <fmt/format.h>

#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "isolux/geometry/shape_description.h"
#include "isolux/scene/shape_writer.h"
#include "isolux/scene/yaml_text.h"

namespace isolux {
namespace {

constexpr std::size_t kLongestName = 200;    ///< bytes of a key; YAML ends at 1024 characters
constexpr std::size_t kShortenedName = 180;  ///< bytes, to leave room for a number

using Entries = std::vector<std::pair<std::string, std::string>>;

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

/// Appends an object, or one that is split by finish.
void append_object(std::string& text, std::span<const Object> split, std::size_t number,
                   const std::string& material, const ShapeWriter& shapes) {
  const Object& object = split.front();
  const std::string name = object.name.empty()
                               ? fmt::format("{} {}", object.shape->describe().kind, number)
                               : object.name;
  text += "  - name: " + to_yaml(name);
  shapes.append(text, 4, split);
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

/// A sky is as its type says, or its coefficients; those of type 16, which has one more, only
/// there.
void append_sky(std::string& text, const Sky& sky) {
  const SkyDistribution& d = sky.distribution;
  int type = 1;
  while (type <= kSkyTypes && standard_sky(type) != d) ++type;
  text += "\nsky:\n";
  if (type <= kSkyTypes) {
    fmt::format_to(std::back_inserter(text), "  type: {}\n", type);
  } else {
    fmt::format_to(std::back_inserter(text), "  distribution: {}\n",
                   to_yaml_list(std::array{d.a, d.b, d.c, d.d, d.e}));
  }
  if (d.depends_on_sun() || sky.sun != sky.up) text += "  sun: " + to_yaml(sky.sun) + '\n';
  text += "  zenith: " + to_yaml(sky.zenith) + '\n';
  if (sky.ground != Rgb{}) text += "  ground: " + to_yaml(sky.ground) + '\n';
  if (sky.up != Sky{}.up) text += "  up: " + to_yaml(sky.up) + '\n';
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

  const ShapeWriter shapes(scene, materials);
  shapes.append_shared(text);

  text += "\nobjects:\n";
  const std::span<const Object> objects(scene.objects);
  for (std::size_t i = 0, n = 0; i < objects.size(); i += n) {
    n = count_split(scene.objects, i);
    append_object(text, objects.subspan(i, n), i + 1, materials[objects[i].material], shapes);
  }

  if (!scene.sources.empty()) text += "\nlights:\n";
  for (const Source& source : scene.sources) append_source(text, source);

  if (scene.sky) append_sky(text, *scene.sky);

  if (!scene.cameras.empty()) text += "\ncameras:\n";
  const std::vector<std::string> cameras = keys_of(scene.cameras, "camera");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    append_camera(text, scene.cameras[i], cameras[i]);
  }
  return text;
}

}  // namespace isolux
