#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/solution/glb.h"
#include "isolux/solution/metadata.h"
#include "isolux/solution/solution.h"

namespace isolux {
namespace {

using nlohmann::json;

// The linear display value of the mean radiosity: about the grey of a wall in daylight.
constexpr double kDisplayMean = 0.3;

/// Everything is derived from what the file will hold, so that saving a loaded solution gives the
/// same bytes again.
float as_saved(double value) {
  const auto saved = static_cast<float>(value);
  if (!std::isfinite(saved)) {
    throw InputError("can't be saved: it holds a number beyond 3.4e38; are the lights too strong?");
  }
  return saved;
}
Rgb as_saved(const Rgb& c) { return {as_saved(c.r), as_saved(c.g), as_saved(c.b)}; }

struct Array {
  std::vector<float> numbers;

  void add(double x) { numbers.push_back(as_saved(x)); }
  void add(const Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const Rgb& c) { add(c.r), add(c.g), add(c.b); }
};

Rgb saved_radiosity(const Vertex& v) { return as_saved(v.reflectance) * as_saved(v.irradiance); }

/// What each vertex sends out, lm/m²: its radiosity, and the exitance of its light.
std::vector<Rgb> shown_exitance(const Triangulation& mesh) {
  std::vector<Rgb> shown;
  for (const Vertex& v : mesh.vertices()) {
    Rgb emission;
    for (TriangleId t : v.triangles) {
      const Rgb e = as_saved(mesh.triangle(t).emission);
      emission = {std::max(emission.r, e.r), std::max(emission.g, e.g), std::max(emission.b, e.b)};
    }
    shown.push_back(saved_radiosity(v) + emission);
  }
  return shown;
}

/// Display value per lm/m²: brings the mean radiosity of the vertices to kDisplayMean.
double display_exposure(const Triangulation& mesh) {
  double sum = 0, count = 0;
  for (const Vertex& v : mesh.vertices()) {
    if (v.on_light) continue;
    sum += luminance(saved_radiosity(v));
    ++count;
  }
  return sum > 0 ? kDisplayMean * count / sum : 1;
}

std::vector<std::uint16_t> display_colors(const Triangulation& mesh, double exposure) {
  std::vector<std::uint16_t> colors;
  const auto add = [&](double value) {
    colors.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * 65535)));
  };
  for (const Rgb& c : shown_exitance(mesh)) {
    add(c.r * exposure), add(c.g * exposure), add(c.b * exposure), add(1);
  }
  return colors;
}

int add_positions(Glb& glb, const Triangulation& mesh) {
  Array positions;
  Bounds bounds;
  for (const Vertex& v : mesh.vertices()) {
    positions.add(v.position);
    bounds.include(Vec3{as_saved(v.position.x), as_saved(v.position.y), as_saved(v.position.z)});
  }
  const int index = add_array<float>(glb, positions.numbers, 3, BufferTarget::vertices);
  json& accessor = glb.json["accessors"][index];
  accessor["min"] = {bounds.lower.x, bounds.lower.y, bounds.lower.z};
  accessor["max"] = {bounds.upper.x, bounds.upper.y, bounds.upper.z};
  return index;
}

int add_colors(Glb& glb, const Triangulation& mesh) {
  const std::vector<std::uint16_t> colors = display_colors(mesh, display_exposure(mesh));
  const int index = add_array<std::uint16_t>(glb, colors, 4, BufferTarget::vertices);
  glb.json["accessors"][index]["normalized"] = true;
  return index;
}

json add_attributes(Glb& glb, const Triangulation& mesh) {
  Array normal, radiosity, irradiance, mean, error, reflectance, object, face, hidden;
  for (const Vertex& v : mesh.vertices()) {
    if (std::max(v.surface.object, v.surface.face) > 1u << 24) {
      throw InputError("can't be saved: a surface has a number beyond 2^24");
    }
    normal.add(v.normal);
    radiosity.add(saved_radiosity(v));
    irradiance.add(v.irradiance);
    mean.add(v.mean_irradiance);
    error.add(v.error);
    reflectance.add(v.reflectance);
    object.add(v.surface.object);
    face.add(v.surface.face);
    hidden.add(v.hidden);
  }
  const auto add = [&](const Array& array, int components) {
    return add_array<float>(glb, array.numbers, components, BufferTarget::vertices);
  };
  return {{"POSITION", add_positions(glb, mesh)},
          {"NORMAL", add(normal, 3)},
          {"COLOR_0", add_colors(glb, mesh)},
          {"_RADIOSITY", add(radiosity, 3)},
          {"_IRRADIANCE", add(irradiance, 3)},
          {"_MEAN_IRRADIANCE", add(mean, 3)},
          {"_ERROR", add(error, 1)},
          {"_REFLECTANCE", add(reflectance, 3)},
          {"_OBJECT", add(object, 1)},
          {"_FACE", add(face, 1)},
          {"_HIDDEN", add(hidden, 1)}};
}

/// Adds indices and what is kept per triangle; returns the accessors' numbers by name.
json add_triangles(Glb& glb, const Triangulation& mesh) {
  std::vector<std::uint32_t> indices;
  std::vector<std::uint8_t> on_light;
  Array emission, shot;
  for (const Triangle& t : mesh.triangles()) {
    if (!t.alive) continue;
    indices.insert(indices.end(), t.vertices.begin(), t.vertices.end());
    emission.add(t.emission);
    shot.add(t.shot);
    on_light.push_back(t.on_light);
  }
  return {{"indices", add_array<std::uint32_t>(glb, indices, 1, BufferTarget::indices)},
          {"emission", add_array<float>(glb, emission.numbers, 3)},
          {"shot", add_array<float>(glb, shot.numbers, 3)},
          {"on_light", add_array<std::uint8_t>(glb, on_light, 1)}};
}

/// The possible edges without a living triangle, two vertices each: they still keep others from
/// crossing them. Adds nothing where there are none, as glTF has no empty arrays.
void add_loose_edges(Glb& glb, const Triangulation& mesh, json& about) {
  std::vector<std::uint32_t> ends;
  for (VertexId a = 0; a < mesh.vertices().size(); ++a) {
    for (VertexId b : mesh.vertex(a).neighbours) {
      if (a < b && !mesh.has_triangle(a, b)) ends.insert(ends.end(), {a, b});
    }
  }
  if (!ends.empty()) about["loose_edges"] = add_array<std::uint32_t>(glb, ends, 1);
}

/// A glTF node that looks along its −z, with +y up, as the camera does.
json camera_node(const Camera& camera, std::size_t index) {
  const Vec3 back = normalized(camera.eye - camera.look_at);
  const Vec3 right = normalized(cross(camera.up, back));
  const Vec3 up = cross(back, right);
  json matrix = json::array();
  for (const Vec3& column : {right, up, back}) {
    for (double x : {column.x, column.y, column.z, 0.0}) matrix.push_back(x);
  }
  for (double x : {camera.eye.x, camera.eye.y, camera.eye.z, 1.0}) matrix.push_back(x);
  return {{"name", camera.name}, {"camera", index}, {"matrix", std::move(matrix)}};
}

void add_scene_graph(json& root, const Scene& scene) {
  // Ours is z up, glTF y up: −90° about x.
  constexpr double kHalf = std::numbers::sqrt2 / 2;
  root["nodes"].push_back({{"name", scene.name}, {"rotation", {-kHalf, 0.0, 0.0, kHalf}}});
  root["nodes"].push_back({{"name", "mesh"}, {"mesh", 0}});
  json children = json::array({1});
  for (const Camera& camera : scene.cameras) {
    children.push_back(root["nodes"].size());
    root["nodes"].push_back(camera_node(camera, root["cameras"].size()));
    root["cameras"].push_back({{"name", camera.name},
                               {"type", "perspective"},
                               {"perspective",
                                {{"yfov", camera.fov * std::numbers::pi / 180},
                                 {"aspectRatio", double(camera.width) / camera.height},
                                 {"znear", std::max(1e-3 * scene.bounds().diagonal(), 1e-9)}}}});
  }
  root["nodes"][0]["children"] = std::move(children);
  root["scenes"].push_back({{"nodes", json::array({0})}});
  root["scene"] = 0;
}

std::string encode(const Solution& solution) {
  const Triangulation& mesh = solution.mesh;
  if (mesh.triangle_count() == 0) {
    throw InputError("can't be saved: it has no triangles; does the scene have a light?");
  }
  Options options = solution.options;
  options.rules = mesh.rules();
  Glb glb;
  json& root = glb.json;
  root["asset"] = {{"version", "2.0"}, {"generator", "isolux " + solution.version}};
  add_scene_graph(root, solution.scene);
  // Unlit: the light is in the colours already.
  root["extensionsUsed"] = json::array({"KHR_materials_unlit"});
  root["materials"].push_back({{"name", "radiosity"},
                               {"pbrMetallicRoughness", {{"metallicFactor", 0.0}}},
                               {"extensions", {{"KHR_materials_unlit", json::object()}}}});

  json attributes = add_attributes(glb, mesh);
  json triangles = add_triangles(glb, mesh);
  json primitive = {{"attributes", std::move(attributes)},
                    {"indices", triangles["indices"]},
                    {"material", 0},
                    {"mode", 4}};
  triangles.erase("indices");
  root["meshes"].push_back({{"primitives", json::array({std::move(primitive)})}});
  root["extras"]["isolux"] = {{"format", 1},
                              {"version", solution.version},
                              {"scene", solution.scene.source},
                              {"options", options_to_json(options)},
                              {"statistics", statistics_to_json(solution.statistics)},
                              {"display_exposure", display_exposure(mesh)},
                              {"triangles", std::move(triangles)}};
  add_loose_edges(glb, mesh, root["extras"]["isolux"]);
  root["buffers"].push_back({{"byteLength", glb.binary.size()}});
  return encode_glb(glb);
}

}  // namespace

void save_solution(const Solution& solution, const std::filesystem::path& path) {
  std::string bytes;
  try {
    bytes = encode(solution);
  } catch (const InputError& error) {
    throw InputError({path.string()}, error.what());
  }
  write_file(path, bytes);
}

}  // namespace isolux
