#pragma once

#include <memory>
#include <mutex>

#include "isolux/geometry/box_tree.h"
#include "isolux/geometry/shape.h"

namespace isolux {

/// A mesh of flat triangles, wound counter-clockwise as seen from outside; one part per triangle.
///
/// It is solid where it is closed and consistently wound: every edge (points at the same place
/// being one) belongs to exactly two triangles, which run along it in opposite directions. Wound
/// inside out it is an unbounded solid. Where a solid mesh runs through itself, the pieces of its
/// surface inside others are no hits of intersect(), though they block light.
///
/// Lines are met as if moved aside by an infinitely small step: one through an edge or a point of
/// the mesh meets exactly one of the triangles around it, one that touches it, or runs inside its
/// surface, may give a pair of hits or none.
///
/// Faces: the groups of triangles joined by edges whose dihedral angle is less than 1e-3 rad off
/// flat, numbered by their first triangle.
class TriangleMesh final : public Shape {
 public:
  /// `triangles` index `points` (m). Each must have an area.
  TriangleMesh(std::vector<Vec3> points, std::vector<std::array<std::uint32_t, 3>> triangles);

  Bounds bounds() const override { return bounds_; }
  /// Those of many triangles keep a tree, made when it is first asked for: ray casters use the
  /// parts.
  void intersect(const Ray& ray, Hits& hits) const override;
  bool occludes(const Ray& ray, double t_min, double t_max) const override;
  bool solid() const override { return solid_; }
  bool contains(const Vec3& point) const override;
  bool unbounded() const override { return unbounded_; }
  std::uint32_t face_count() const override { return face_count_; }
  std::optional<double> area() const override { return area_; }
  std::optional<TriangleSoup> triangulate(double max_edge) const override;
  ShapeDescription describe() const override;

  std::size_t part_count() const override { return soup_.triangles.size(); }
  Bounds part_bounds(std::size_t part) const override;
  void intersect_part(std::size_t part, const Ray& ray, Hits& hits) const override;
  bool part_occludes(std::size_t part, const Ray& ray, double t_min, double t_max) const override;

 private:
  struct Line;
  Line line(const Ray& ray) const;
  /// The hit, marked where the line leaves.
  std::optional<Hit> hit(std::size_t part, const Line& line) const;
  /// Calls visit(hit) for each triangle that the line meets, until one returns true; that then.
  template <typename Visit>
  bool any_hit(const Line& line, const Visit& visit) const;
  const BoxTree& tree() const;

  TriangleSoup soup_;
  std::vector<Vec3> normals_;         ///< one a triangle
  std::vector<std::uint32_t> faces_;  ///< one a triangle
  std::uint32_t face_count_ = 0;
  double area_;
  Bounds bounds_;
  bool solid_ = false;
  bool unbounded_ = false;
  mutable std::once_flag tree_made_;
  mutable std::unique_ptr<const BoxTree> tree_;
};

}  // namespace isolux
