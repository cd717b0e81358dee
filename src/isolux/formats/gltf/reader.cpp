#include "isolux/formats/gltf/reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "isolux/core/error.h"
#include "isolux/formats/gltf/materials.h"
#include "isolux/formats/gltf/placement.h"
#include "isolux/geometry/tessellation.h"
#include "isolux/scene/spelling.h"

namespace isolux {
namespace gltf {
namespace {

/// Extensions that a file may require: they are read, or change what surfaces look like alone, as
/// all do whose name begins like that.
constexpr std::array<std::string_view, 3> kExtensions = {
    "KHR_lights_punctual", "KHR_mesh_quantization", "KHR_texture_transform"};
constexpr std::string_view kLook = "KHR_materials_";

constexpr int kY = 1;  ///< the axis that points up

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : document_(path),
        assembly_(path.stem().string()),
        materials_(document_, assembly_.notes()) {}

  SceneFile read();

 private:
  struct Placed {
    std::size_t node;
    Affine map;  ///< to the world
  };
  void check_extensions();
  /// All nodes of the scene, each before its children.
  std::vector<Placed> placed_nodes();
  void add_mesh(const Json& node, const Affine& map);
  void add_light(const Json& light, const Affine& map);
  TriangleSoup soup_of(const Json& primitive);

  Document document_;
  Assembly assembly_;
  Materials materials_;
  std::vector<std::size_t> uses_;  ///< of each mesh
  std::map<std::pair<std::size_t, std::size_t>, std::shared_ptr<const Shape>>
      shapes_;  ///< by mesh and primitive
};

void Reader::check_extensions() {
  const Json root = document_.root();
  if (const auto extras = root.find("extras"); extras && extras->is_object()) {
    if (extras->find("isolux")) {
      root.fail("is a solution of isolux, not a scene: show it with render, measure or info");
    }
  }
  const std::string& version = root.require("asset").require("version").text();
  if (!version.starts_with("2.")) {
    root.fail(fmt::format("is glTF {}: only 2.0 is read", in_quotes(version)));
  }
  const auto required = root.find("extensionsRequired");
  for (std::size_t i = 0; required && i < required->size(); ++i) {
    const std::string& name = required->item(i).text();
    const bool known = name.starts_with(kLook) ||
                       std::find(kExtensions.begin(), kExtensions.end(), name) != kExtensions.end();
    if (!known) {
      required->item(i).fail(
          fmt::format("{} is not read: export the scene without it", in_quotes(name)));
    }
  }
}

std::vector<Reader::Placed> Reader::placed_nodes() {
  const Json root = document_.root();
  const std::size_t count = document_.count("nodes");
  std::vector<bool> met(count, false);
  std::vector<Placed> all, open;
  const auto open_list = [&](const Json& list, const Affine& map) {
    for (std::size_t i = list.size(); i-- > 0;) {
      const std::size_t node = document_.number("nodes", list.item(i));
      if (met[node]) list.item(i).fail(fmt::format("nodes[{}] is placed twice", node));
      met[node] = true;
      open.push_back({node, map});
    }
  };
  if (document_.count("scenes") > 0) {
    const auto chosen = root.find("scene");
    const Json scene = chosen ? document_.item("scenes", *chosen) : root.require("scenes").item(0);
    if (const auto nodes = scene.find("nodes")) open_list(*nodes, {});
  }
  while (!open.empty()) {
    Placed placed = open.back();
    open.pop_back();
    const Json node = root.require("nodes").item(placed.node);
    placed.map = placed.map * map_of(node);
    all.push_back(placed);
    if (const auto children = node.find("children")) open_list(*children, placed.map);
  }
  return all;
}

TriangleSoup Reader::soup_of(const Json& primitive) {
  TriangleSoup soup;
  const std::vector<double> places =
      document_.numbers(primitive.require("attributes").require("POSITION"), 3);
  for (std::size_t i = 0; i < places.size(); i += 3) {
    soup.points.push_back({places[i], places[i + 1], places[i + 2]});
    if (!is_finite(soup.points.back())) primitive.fail("has a point that is not finite");
  }
  std::vector<std::uint32_t> order;
  if (const auto indices = primitive.find("indices")) {
    order = document_.indices(*indices, soup.points.size());
  } else {
    for (std::uint32_t i = 0; i < soup.points.size(); ++i) order.push_back(i);
  }
  const std::uint64_t mode = primitive.integer("mode", 6, 4);
  if (mode < 4) {
    assembly_.notes().add("points and lines: left out, they have no area");
  } else if (mode == 4) {
    for (std::size_t i = 0; i + 2 < order.size(); i += 3) {
      soup.triangles.push_back({order[i], order[i + 1], order[i + 2]});
    }
  } else {
    for (std::size_t i = 0; i + 2 < order.size(); ++i) {  // a strip or a fan
      const std::size_t odd = i % 2;
      if (mode == 5) {
        soup.triangles.push_back({order[i], order[i + 1 + odd], order[i + 2 - odd]});
      } else {
        soup.triangles.push_back({order[0], order[i + 1], order[i + 2]});
      }
    }
  }
  return soup;
}

void Reader::add_mesh(const Json& node, const Affine& map) {
  const Json index = node.require("mesh");
  const std::size_t number = document_.number("meshes", index);
  const Json mesh = document_.item("meshes", index);
  const Json primitives = mesh.require("primitives");
  const std::string name = node.text("name").empty() ? mesh.text("name") : node.text("name");
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const Json primitive = primitives.item(i);
    if (primitive.find("targets")) assembly_.notes().left_out("targets", "meshes are at rest");
    if (primitive.require("attributes").find("COLOR_0")) {
      assembly_.notes().left_out("COLOR_0", "meshes have the plain color of their material");
    }
    const Look& look = materials_.of(primitive);
    const bool any_side = look.two_sided && !(max_channel(look.exitance) > 0);
    const bool shared = uses_[number] > 1;
    const auto [place, is_new] = shapes_.try_emplace({number, i});
    TriangleSoup soup;
    if (is_new) soup = soup_of(primitive);
    if (!shared) {
      for (Vec3& p : soup.points) p = map.point(p);
      if (map.determinant() < 0) flip(soup);
    }
    try {
      std::shared_ptr<const Shape>& shape = place->second;
      if (is_new) shape = assembly_.mesh(std::move(soup), any_side);
      assembly_.add(primitives.size() == 1 ? name : name + '/' + look.material,
                    shared && shape ? assembly_.placed(shape, map) : shape, look);
    } catch (const InputError& error) {
      primitive.fail(error.what());
    }
  }
}

SceneFile Reader::read() {
  check_extensions();
  const std::vector<Placed> placed = placed_nodes();
  const Json root = document_.root();
  uses_.resize(document_.count("meshes"));
  for (const auto& [number, map] : placed) {
    const auto mesh = root.require("nodes").item(number).find("mesh");
    if (mesh) ++uses_[document_.number("meshes", *mesh)];
  }
  for (const auto& [number, map] : placed) {
    const Json node = root.require("nodes").item(number);
    if (node.find("mesh")) add_mesh(node, map);
    if (node.find("skin")) assembly_.notes().left_out("skin", "meshes are at rest");
    if (const auto camera = node.find("camera")) {
      if (const auto seen = camera_of(document_.item("cameras", *camera), map)) {
        assembly_.cameras().push_back(*seen);
      } else {
        assembly_.notes().add("cameras that are not perspective: left out");
      }
    }
    if (const auto light = node.extension("KHR_lights_punctual")) {
      add_light(light->require("light"), map);
    }
  }
  if (root.find("animations")) assembly_.notes().left_out("animations", "meshes are at rest");
  try {
    return assembly_.finish(kY);
  } catch (const InputError& error) {
    root.fail(error.what());
  }
}

void Reader::add_light(const Json& index, const Affine& map) {
  const auto extension = document_.root().extension("KHR_lights_punctual");
  if (!extension) index.fail("there are no lights in this file");
  const Json lights = extension->require("lights");
  const std::uint64_t number = index.integer(std::uint64_t{1} << 32);
  if (number >= lights.size()) index.fail(fmt::format("there is no light {}", number));
  assembly_.sources().push_back(source_of(lights.item(number), map));
}

}  // namespace
}  // namespace gltf

SceneFile read_gltf(const std::filesystem::path& path) { return gltf::Reader(path).read(); }

}  // namespace isolux
