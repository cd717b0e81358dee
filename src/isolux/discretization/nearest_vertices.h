#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "isolux/discretization/interpolation.h"

namespace isolux {

/// Finds light for points of the surface that no triangle covers: the vertices near by. It keeps
/// the mesh as it stood when it was built.
class NearestVertices {
 public:
  explicit NearestVertices(const Triangulation& mesh);
  ~NearestVertices();
  NearestVertices(const NearestVertices&) = delete;
  NearestVertices& operator=(const NearestVertices&) = delete;

  /// The three nearest vertices of living triangles that face as `normal` does, each weighing one
  /// over the square of its distance. Nothing where none within δ faces that way, within 60° if
  /// possible, else within 90°: there it is dark. May be asked from many threads at once.
  std::optional<MeshPlace> place(const Vec3& point, const Vec3& normal) const;

  /// The same of the first three that `seen` is true of, out of the sixteen nearest; nothing where
  /// there are none.
  std::optional<MeshPlace> place(const Vec3& point, const Vec3& normal,
                                 const std::function<bool(VertexId)>& seen) const;

 private:
  class Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace isolux
