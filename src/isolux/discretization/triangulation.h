#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/core/vec3.h"
#include "isolux/discretization/vertex_grid.h"
#include "isolux/raycast/ray_caster.h"

namespace isolux {

// Notation of §3.2.2 of the paper
//   v, w       vertices                        VertexId, Vertex
//   δ          longest edge, m                 Rules::max_edge
//   Δ          least area of a triangle, m²    Rules::min_area
//   α_n        tolerance between normals, rad  Rules::normal_tolerance
//   α_s        tolerance between ΔB's          Options::contrast (the radiosity procedure's)
//   V.ρ        reflectance                     Vertex::reflectance
//   V.B, V.ΔB  radiosity, lm/m²                Vertex::radiosity(), delta_radiosity()
// Vertices store irradiance E (lx) rather than B = ρ E, so that black surfaces have lux too.

using VertexId = std::uint32_t;
using TriangleId = std::uint32_t;

/// The geometric rules of §3.2.2; where they conflict, the lower number holds.
struct Rules {
  double max_edge = 0.1;     ///< δ, m: no edge is longer (rule 1)
  double min_area = 3.5e-4;  ///< Δ, m²: no split makes a smaller triangle (rule 2)
  double normal_tolerance =
      0.5235987755982988;  ///< α_n, rad: between the corners of a triangle (rule 4)
};

/// A point of the scene that may become a vertex (rule 3).
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;  ///< unit length, to the side that receives light
  SurfaceId surface;
  Rgb reflectance;
};

struct Vertex : SurfacePoint {
  /// Where its light is gathered: the position, but for the corners of a light, which lie a
  /// thousandth towards the light's inside, so that in a crease they see the adjoining surface.
  Vec3 gather_point;
  Rgb irradiance;        ///< E accumulated over all shots, lx
  Rgb delta_irradiance;  ///< the part of it that came from the current shot, lx
  Rgb mean_irradiance;   ///< E as the triangles around have it on average, by which they send, lx;
                         ///< zero where it was not found out
  double error = 0;  ///< of the irradiance's luminance, lx: 95 in 100 are less wrong; 0: unknown
  bool on_light = false;
  bool hidden = false;  ///< close under another sheet: it has the light of what is seen beside it
  std::vector<VertexId> neighbours;   ///< ends of the possible edges from here
  std::vector<TriangleId> triangles;  ///< the triangles around it

  Rgb radiosity() const { return reflectance * irradiance; }
  Rgb delta_radiosity() const { return reflectance * delta_irradiance; }
};

struct Triangle {
  std::array<VertexId, 3> vertices{};  ///< counter-clockwise seen from the lit side
  bool alive = true;                   ///< dead ones keep their id, so that ids stay valid
  bool on_light = false;
  bool flat = false;  ///< its corners' normals are its own, to within 1e-9
  Vec3 normal;        ///< unit length
  double area = 0;    ///< m²
  Rgb emission;       ///< E_i, lm/m², zero but for the triangles of lights
  Rgb shot;           ///< radiosity sent out so far, lm/m²
};

/// The growing discretization: a triangulation of points of the scene, with its possible edges
/// (§3.2.2). Ids are indices, given in order of birth and never used again.
class Triangulation {
 public:
  /// An empty triangulation for a scene within `bounds`. Throws InputError where the rules'
  /// numbers are not positive, or δ is so small against the bounds that the vertex grid would not
  /// fit into memory.
  Triangulation(const Rules& rules, const Bounds& bounds);

  /// A triangulation as it was: with all lists of its vertices, and its dead triangles. Throws
  /// InputError where an id does not exist or an invariant does not hold.
  Triangulation(const Rules& rules, const Bounds& bounds, std::vector<Vertex> vertices,
                std::vector<Triangle> triangles);

  const Rules& rules() const { return rules_; }
  std::span<const Vertex> vertices() const { return vertices_; }
  std::span<const Triangle> triangles() const { return triangles_; }
  std::span<Vertex> vertices() { return vertices_; }
  std::span<Triangle> triangles() { return triangles_; }
  const Vertex& vertex(VertexId id) const { return vertices_[id]; }
  Vertex& vertex(VertexId id) { return vertices_[id]; }
  const Triangle& triangle(TriangleId id) const { return triangles_[id]; }
  Triangle& triangle(TriangleId id) { return triangles_[id]; }
  /// The number of living triangles, those of lights included.
  std::size_t triangle_count() const { return alive_; }

  /// Cuts a light into triangles: `soup` becomes vertices and triangles marked `on_light`, whose
  /// vertices never take other edges. Invalidates references into vertices() and triangles().
  void add_light(const TriangleSoup& soup, SurfaceId surface, const Rgb& reflectance,
                 const Rgb& exitance);

  /// extend-triangulation (§3.2.2): makes `point` a vertex, connects it to every vertex within δ
  /// whose segment crosses no possible edge, and turns the three-cycles that this closes into
  /// triangles. Returns the new vertex, its light being zero, with `neighbours` the vertices it
  /// was connected to; nothing, and no change, where a vertex stands closer than least_spacing() or
  /// a living triangle covers the point already.
  /// All ids stay valid; references into vertices() and triangles() don't. Cost: the vertices
  /// within δ times the edges within √5/2 δ.
  std::optional<VertexId> extend(const SurfacePoint& point);

  /// split(R) (§3.2.5): puts `point`, a point of the scene over `triangle`, into the triangle,
  /// which is replaced by up to three (fewer where rule 4 forbids one). Each child inherits what
  /// its parent has emitted and shot; the new vertex's light is zero. Returns the new vertex;
  /// nothing, and no change, where the triangle is dead or a light's, the point falls outside it or
  /// within 2 % of its sides, or a child would be smaller than Δ (rule 2). Ids and references as
  /// extend().
  std::optional<VertexId> split(TriangleId triangle, const SurfacePoint& point);

  /// remove-from-triangulation (§3.2.4): the triangle dies; its vertices and its edges stay, as
  /// possible edges. A dead triangle, or a light's, is left as it is. Everything stays valid.
  void remove(TriangleId triangle);

  /// Puts `point`, a surface point over the middle of edge ab, into that edge: the one or two
  /// triangles at it become two or four, which inherit emission and what was shot; then flips edges
  /// around it until they are Delaunay. The edge ab is gone. Returns the new vertex, its light
  /// being zero; nothing, and no change, where ab has no triangle or a light's (`on_light`), or a
  /// child would stand against rule 1, rule 4, or steeper than α_n off a corner's normal. Ids and
  /// references as extend(). Cost: constant.
  std::optional<VertexId> split_edge(VertexId a, VertexId b, const SurfacePoint& point);

  /// Forgets the dead triangles. Those that live get new ids, in their old order; vertices keep
  /// theirs. Cost: linear.
  void compact();

  /// Turns the edge ab between two triangles into the other diagonal of their quadrilateral, where
  /// that is Delaunay (the angles opposite ab sum to more than π) and the two new triangles obey
  /// the rules as in split_edge(); the unshot power stays what it was in sum. Returns whether it
  /// did; the two triangles die then, and edge ab is gone.
  bool flip(VertexId a, VertexId b);

  /// Flips until no edge of `edges`, or edge that a flip touched, asks for it. Cost: linear as a
  /// rule; at most 16 flips for each of the edges.
  void make_delaunay(std::vector<std::pair<VertexId, VertexId>> edges);

  /// Whether three vertices, in this order, may be a triangle by rules 1 and 4, its own normal no
  /// more than α_n off those of its corners.
  bool may_be_triangle(VertexId a, VertexId b, VertexId c) const;

  /// The living triangle wound from a to b, if there is one.
  std::optional<TriangleId> triangle_at(VertexId a, VertexId b) const;

  /// The vertices that extend() would connect `point` to, nearest first, without changing
  /// anything.
  std::vector<VertexId> connectable(const SurfacePoint& point) const;

  /// Whether an edge stands between the two vertices.
  bool has_edge(VertexId a, VertexId b) const;

  /// Whether a living triangle has both vertices.
  bool has_triangle(VertexId a, VertexId b) const;

  /// No vertex is born by extension closer than this (m) to one whose normal is within α_n: 0.2 √Δ.
  double least_spacing() const;

  /// Puts back a vertex, a triangle with its edges, or another possible edge as saved; for loading
  /// a solution. Throws InputError where a vertex does not exist or is repeated, an edge would have
  /// three triangles, or would leave a light.
  VertexId restore_vertex(Vertex vertex);
  TriangleId restore_triangle(const std::array<VertexId, 3>& vertices, const Rgb& emission,
                              const Rgb& shot, bool on_light);
  void restore_edge(VertexId a, VertexId b);

  /// Checks every invariant (docs/architecture.md lists them); returns a line for each violation,
  /// at most 20. Cost: linear.
  std::vector<std::string> validate() const;

 private:
  struct PlaneFrame;
  bool compatible(const Vec3& normal_a, const Vec3& normal_b) const;
  /// The vertices around a point that it may have to do with.
  struct Neighbourhood {
    std::vector<VertexId> near;  ///< w: those it may be connected to, within δ, nearest first
    std::vector<VertexId> far;   ///< all within √5/2 δ
  };
  Neighbourhood neighbourhood(const SurfacePoint& point) const;
  std::vector<VertexId> connectable(const SurfacePoint& point, const Neighbourhood& around,
                                    const PlaneFrame& plane) const;
  VertexId add_vertex(const SurfacePoint& point);
  void add_edge(VertexId a, VertexId b);
  TriangleId add_triangle(VertexId a, VertexId b, VertexId c);
  void remove_edge(VertexId a, VertexId b);
  bool faces_outward(VertexId a, VertexId b, VertexId c) const;
  bool closes_triangle(VertexId v, VertexId a, VertexId b, std::span<const VertexId> near,
                       const PlaneFrame& plane) const;
  bool crowded(const SurfacePoint& point) const;
  bool covered(std::span<const VertexId> near, const PlaneFrame& plane) const;
  bool side_free(VertexId a, VertexId b, VertexId opposite, const PlaneFrame& plane) const;

  Rules rules_;
  double cos_normal_tolerance_;
  VertexGrid grid_;
  std::vector<Vertex> vertices_;
  std::vector<Triangle> triangles_;
  std::size_t alive_ = 0;
};

}  // namespace isolux
