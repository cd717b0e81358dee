#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/scene/reader.h"
#include "isolux/solution/glb.h"
#include "isolux/solution/metadata.h"
#include "isolux/solution/solution.h"

namespace isolux {
namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxIndex = std::numeric_limits<std::uint32_t>::max();
// Restoring costs the square of this for each vertex; a mesh has about six.
constexpr std::size_t kMaxTrianglesAtVertex = 10'000;

[[noreturn]] void damaged(const std::string& what) { throw InputError("is damaged: " + what); }

const std::string& text_member(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_string()) damaged(fmt::format("'{}' is not a text", key));
  return value.get_ref<const std::string&>();
}

const json& first_primitive(const json& root) {
  const json& meshes = member(root, "meshes");
  if (!meshes.is_array() || meshes.empty()) damaged("it has no mesh");
  const json& primitives = member(meshes[0], "primitives");
  if (!primitives.is_array() || primitives.empty()) damaged("its mesh is empty");
  return primitives[0];
}

/// A vertex attribute, or an array with one element for each triangle; all numbers are finite.
template <typename Number>
std::vector<Number> array(const Glb& glb, const json& owner, const char* key, int components,
                          std::size_t count) {
  auto numbers = read_array<Number>(glb, integer_member(owner, key, kMaxIndex), components, count);
  if constexpr (std::is_floating_point_v<Number>) {
    for (Number x : numbers) {
      if (!std::isfinite(x)) damaged(fmt::format("'{}' holds a number that is not finite", key));
    }
  }
  return numbers;
}

Vec3 vec3_at(const std::vector<float>& a, std::size_t i) {
  return {a[3 * i], a[3 * i + 1], a[3 * i + 2]};
}
Rgb rgb_at(const std::vector<float>& a, std::size_t i) {
  return {a[3 * i], a[3 * i + 1], a[3 * i + 2]};
}
std::uint32_t index_at(const std::vector<float>& a, std::size_t i, double limit, const char* what) {
  if (!(a[i] >= 0 && a[i] < limit && a[i] == std::floor(a[i]))) {
    damaged(fmt::format("vertex {} lies on {} {}, which does not exist", i, what, a[i]));
  }
  return static_cast<std::uint32_t>(a[i]);
}

/// The corners of every triangle, each below `vertex_count`.
std::vector<std::uint32_t> read_corners(const Glb& glb, std::size_t vertex_count) {
  const json& primitive = first_primitive(glb.json);
  const std::uint64_t accessor = integer_member(primitive, "indices", kMaxIndex);
  const std::size_t count = accessor_count(glb, accessor);
  if (count == 0 || count % 3 != 0) damaged("its number of indices is not that of triangles");
  auto corners = read_array<std::uint32_t>(glb, accessor, 1, count);
  std::vector<std::uint32_t> around(vertex_count);
  for (std::uint32_t corner : corners) {
    if (corner >= vertex_count) damaged(fmt::format("there is no vertex {}", corner));
    if (++around[corner] > kMaxTrianglesAtVertex) damaged("too many triangles share a vertex");
  }
  return corners;
}

std::vector<Vertex> read_vertices(const Glb& glb, const Scene& scene) {
  const json& attributes = member(first_primitive(glb.json), "attributes");
  const std::size_t n = accessor_count(glb, integer_member(attributes, "POSITION", kMaxIndex));
  const auto position = array<float>(glb, attributes, "POSITION", 3, n);
  const auto normal = array<float>(glb, attributes, "NORMAL", 3, n);
  const auto irradiance = array<float>(glb, attributes, "_IRRADIANCE", 3, n);
  const auto mean = array<float>(glb, attributes, "_MEAN_IRRADIANCE", 3, n);
  const auto error = array<float>(glb, attributes, "_ERROR", 1, n);
  const auto reflectance = array<float>(glb, attributes, "_REFLECTANCE", 3, n);
  const auto object = array<float>(glb, attributes, "_OBJECT", 1, n);
  const auto face = array<float>(glb, attributes, "_FACE", 1, n);
  const auto hidden = array<float>(glb, attributes, "_HIDDEN", 1, n);

  const Bounds bounds = scene.bounds();
  const double slack = 1e-3 * bounds.diagonal();
  std::vector<Vertex> vertices(n);
  for (std::size_t i = 0; i < n; ++i) {
    Vertex& v = vertices[i];
    v.position = v.gather_point = vec3_at(position, i);
    v.normal = vec3_at(normal, i);
    v.irradiance = rgb_at(irradiance, i);
    v.mean_irradiance = rgb_at(mean, i);
    v.error = error[i];
    v.reflectance = rgb_at(reflectance, i);
    v.surface.object = index_at(object, i, static_cast<double>(scene.objects.size()), "object");
    v.surface.face = index_at(face, i, 1 << 25, "face");
    v.hidden = hidden[i] != 0;
    Bounds with_vertex = bounds;
    with_vertex.include(v.position);
    if (with_vertex.diagonal() > bounds.diagonal() + slack) {
      damaged(fmt::format("vertex {} lies outside the scene", i));
    }
    if (std::abs(length(v.normal) - 1) > 1e-3) {
      damaged(fmt::format("the normal of vertex {} has not length 1", i));
    }
    if (!(v.error >= 0)) damaged(fmt::format("the error of vertex {} is negative", i));
    if (!(min_channel(v.reflectance) >= 0 && max_channel(v.reflectance) <= 1)) {
      damaged(fmt::format("the reflectance of vertex {} is not from 0 to 1", i));
    }
  }
  return vertices;
}

void restore_loose_edges(const Glb& glb, const json& about, Triangulation& mesh) {
  const std::uint64_t accessor = integer_member(about, "loose_edges", kMaxIndex);
  const auto ends = read_array<std::uint32_t>(glb, accessor, 1, accessor_count(glb, accessor));
  if (ends.size() % 2 != 0) damaged("an edge has only one end");
  std::vector<std::uint32_t> around(mesh.vertices().size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i] < around.size() && ++around[ends[i]] > kMaxTrianglesAtVertex) {
      damaged("too many edges share a vertex");
    }
    if (i % 2 == 1) mesh.restore_edge(ends[i - 1], ends[i]);
  }
}

Triangulation read_mesh(const Glb& glb, const json& about, const Scene& scene, const Rules& rules) {
  std::vector<Vertex> vertices = read_vertices(glb, scene);
  const auto corners = read_corners(glb, vertices.size());
  const std::size_t n = corners.size() / 3;
  const json& triangles = member(about, "triangles");
  const auto emission = array<float>(glb, triangles, "emission", 3, n);
  const auto shot = array<float>(glb, triangles, "shot", 3, n);
  const auto on_light = array<std::uint8_t>(glb, triangles, "on_light", 1, n);

  for (std::size_t i = 0; i < n; ++i) {
    for (int k = 0; k < 3 && on_light[i]; ++k) vertices[corners[3 * i + k]].on_light = true;
  }
  Triangulation mesh(rules, scene.bounds());
  for (Vertex& vertex : vertices) mesh.restore_vertex(std::move(vertex));
  for (std::size_t i = 0; i < n; ++i) {
    const std::array<VertexId, 3> t = {corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]};
    for (VertexId v : t) {
      if (mesh.vertex(v).on_light != (on_light[i] != 0)) {
        damaged(fmt::format("triangle {} lies on a light in part", i));
      }
    }
    mesh.restore_triangle(t, rgb_at(emission, i), rgb_at(shot, i), on_light[i] != 0);
  }
  if (about.contains("loose_edges")) restore_loose_edges(glb, about, mesh);
  return mesh;
}

/// Runs `read`, adding the file's name to its errors.
template <typename F>
decltype(auto) naming(const std::filesystem::path& path, F&& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError({path.string()}, error.what());
  }
}

}  // namespace

Solution load_solution(const std::filesystem::path& path) {
  const std::string bytes = read_file(path);
  const Glb glb = naming(path, [&] { return decode_glb(bytes); });
  const json& about = naming(path, [&]() -> const json& {
    const json& found = member(member(glb.json, "extras"), "isolux");
    if (integer_member(found, "format", kMaxIndex) != 1) {
      throw InputError("was written in a newer format of solutions; update isolux to read it");
    }
    return found;
  });
  const std::string& text = naming(path, [&] { return text_member(about, "scene"); });
  Scene scene = read_scene(text, path.string() + " (scene)");
  return naming(path, [&] {
    const Options options = options_from_json(member(about, "options"));
    const Statistics statistics = statistics_from_json(member(about, "statistics"));
    Triangulation mesh = [&] {
      try {
        return read_mesh(glb, about, scene, options.rules);
      } catch (const InputError& error) {
        const std::string reason = error.what();
        if (reason.starts_with("is ")) throw;
        damaged(reason);  // by the triangulation's own rules
      }
    }();
    return Solution{std::move(scene), std::move(mesh), options, statistics,
                    text_member(about, "version")};
  });
}

}  // namespace isolux
