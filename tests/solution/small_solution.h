#pragma once

#include <unistd.h>

#include <filesystem>
#include <numbers>
#include <string>

#include "isolux/scene/reader.h"
#include "isolux/solution/solution.h"

namespace isolux {

/// A folder that is removed with everything in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "isolux-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

constexpr double kSmallIrradiance = 100;  // lx, everywhere in small_solution()
constexpr double kSmallExitance = 2000;   // lm/m², of its lamp

/// A unit room of reflectance 0.5 with a ball of 0.8 at its centre and a black lamp in the ceiling.
/// Its mesh, made by hand: two triangles for each wall but the last and for the lamp, none for the
/// ball; one vertex alone. Every vertex has kSmallIrradiance; all numbers fit into a float.
inline Solution small_solution() {
  Scene scene = read_scene(R"(isolux: 1
name: Small room
materials:
  wall: {reflectance: 0.5}
  ball: {reflectance: 0.8}
  lamp: {reflectance: 0}
objects:
  - {name: room, material: wall, shape: {box: {lower: [0, 0, 0], upper: [1, 1, 1], inward: true}}}
  - {name: ball, material: ball, shape: {sphere: {center: [0.5, 0.5, 0.5], radius: 0.2}}}
  - name: lamp
    material: lamp
    shape: {parallelogram: {corner: [0.4375, 0.4375, 1], u: [0, 0.125, 0], v: [0.125, 0, 0]}}
    sides: front
    emission: {exitance: 2000}
cameras:
  front: {eye: [0.5, 0.0625, 0.5], look_at: [0.5, 1, 0.5], fov: 75, size: [64, 48]}
)",
                           "small.yaml");
  Options options;
  options.method = Method::shooting;
  options.rules = {2, 0.001, 0.5};
  options.seed = 18446744073709551615u;
  options.camera = "front";
  options.contrast = 1.0 / 3;
  Triangulation mesh(options.rules, scene.bounds());
  const auto wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v, const Rgb& emission) {
    const bool lamp = emission != Rgb{};
    const std::uint32_t object = lamp ? 2 : 0;
    std::array<VertexId, 4> ids{};
    int k = 0;
    for (const Vec3& p : {corner, corner + u, corner + u + v, corner + v}) {
      Vertex vertex;
      vertex.position = vertex.gather_point = p;
      vertex.normal = normalized(cross(u, v));
      vertex.surface = {object, 0};
      vertex.reflectance = gray(lamp ? 0 : 0.5);
      vertex.irradiance = gray(kSmallIrradiance);
      vertex.on_light = lamp;
      ids[k++] = mesh.restore_vertex(vertex);
    }
    mesh.restore_triangle({ids[0], ids[1], ids[2]}, emission, gray(lamp ? 2000 : 12.5), lamp);
    mesh.restore_triangle({ids[0], ids[2], ids[3]}, emission, gray(0), lamp);
  };
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, o{};
  wall({0.4375, 0.4375, 1}, y * 0.125, x * 0.125, gray(kSmallExitance));
  wall(o, x, y, {}), wall(z, y, x, {});
  wall(o, z, x, {}), wall(y, x, z, {});
  wall(o, y, z, {}), wall(x, z, y, {});
  mesh.remove(static_cast<TriangleId>(mesh.triangles().size() - 1));

  Statistics statistics;
  statistics.iterations = 7;
  statistics.converged = true;
  statistics.triangles = mesh.triangle_count();
  statistics.vertices = mesh.vertices().size();
  statistics.shadow_rays = 1ull << 60;
  statistics.emitted_flux = 31.25;
  statistics.unshot_flux = 0.1;
  statistics.wall_seconds = 3;
  return {std::move(scene), std::move(mesh), options, statistics, "0.1.0"};
}

}  // namespace isolux
