#pragma once

#include <vector>

#include "isolux/discretization/triangulation.h"
#include "isolux/radiosity/visibility.h"

namespace isolux {

/// Adds cells × cells squares, each cut in two, that cover the parallelogram corner + a u + b v,
/// facing along u × v; a thousandth of a cell is left free along the sides, so that no vertex lies
/// in a crease.
inline void add_grid(Triangulation& mesh, const Vec3& corner, const Vec3& u, const Vec3& v,
                     int cells, SurfaceId surface, const Rgb& reflectance) {
  const Vec3 normal = normalized(cross(u, v));
  const auto first = static_cast<VertexId>(mesh.vertices().size());
  const double inset = 1e-3 / cells;
  const auto part = [&](int i) { return inset + (1 - 2 * inset) * i / cells; };
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      Vertex vertex;
      vertex.position = vertex.gather_point = corner + u * part(i) + v * part(j);
      vertex.normal = normal;
      vertex.surface = surface;
      vertex.reflectance = reflectance;
      mesh.restore_vertex(vertex);
    }
  }
  const auto at = [&](int i, int j) { return first + static_cast<VertexId>(j * (cells + 1) + i); };
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      mesh.restore_triangle({at(i, j), at(i + 1, j), at(i + 1, j + 1)}, {}, {}, false);
      mesh.restore_triangle({at(i, j), at(i + 1, j + 1), at(i, j + 1)}, {}, {}, false);
    }
  }
}

/// The six sides of a box from inside, all of object 0.
inline Triangulation box_room_mesh(const Vec3& size, int cells, const Rgb& reflectance) {
  Bounds bounds;
  bounds.include(Vec3{}), bounds.include(size);
  const double edge = 1.5 * std::max({size.x, size.y, size.z}) / cells;
  Triangulation mesh({edge, edge * edge / 100, 0.5}, bounds);
  const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z};
  add_grid(mesh, {}, x, y, cells, {0, 0}, reflectance);
  add_grid(mesh, z, y, x, cells, {0, 1}, reflectance);
  add_grid(mesh, {}, y, z, cells, {0, 2}, reflectance);
  add_grid(mesh, x, z, y, cells, {0, 3}, reflectance);
  add_grid(mesh, {}, z, x, cells, {0, 4}, reflectance);
  add_grid(mesh, y, x, z, cells, {0, 5}, reflectance);
  return mesh;
}

/// The mesh's vertices as receivers.
inline std::vector<Receiver> receivers_of(const Triangulation& mesh) {
  std::vector<Receiver> receivers;
  for (const Vertex& vertex : mesh.vertices()) {
    receivers.push_back({vertex.gather_point, vertex.normal});
  }
  return receivers;
}

}  // namespace isolux
