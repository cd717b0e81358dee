#pragma once

#include "isolux/geometry/shape.h"

namespace isolux {

/// How the triangles of a mesh hang together; points at the same place count as one.
struct MeshTopology {
  /// Every edge belongs to exactly two triangles that run along it in opposite directions.
  bool closed = true;
  /// For each triangle its smooth piece: the pieces are joined by edges that are less than the
  /// tolerance off flat, and numbered by their first triangle.
  std::vector<std::uint32_t> faces;
  std::uint32_t face_count = 0;
};

/// `normals` holds one unit vector a triangle; `flat` is the tolerance, rad.
MeshTopology find_topology(const TriangleSoup& soup, const std::vector<Vec3>& normals, double flat);

}  // namespace isolux
