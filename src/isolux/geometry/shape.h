#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "isolux/geometry/segment_block.h"

namespace isolux {

struct ShapeDescription;

/// A point where a line meets a surface.
struct Hit {
  double t = 0;            ///< along the ray, in lengths of its direction
  Vec3 point;              ///< on the surface, in double precision
  Vec3 normal;             ///< unit length, pointing out of the solid
  std::uint32_t face = 0;  ///< which smooth piece of the shape: its numbering is the shape's own
};

using Hits = std::vector<Hit>;

/// Triangles that stand for a shape, wound counter-clockwise as seen from outside.
struct TriangleSoup {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// A surface or solid, exactly as drawn: what rays need to know of it (§2.1, §3 of the paper).
///
/// A shape is made of one or more *parts*, each with its own bounds, so that a ray caster can keep
/// a mesh of a million triangles in its tree. Most shapes are one part.
///
/// Shapes are immutable and may be asked from many threads at once. Constructors throw InputError
/// (without a location: the reader that called adds it) where the numbers make no shape.
class Shape {
 public:
  virtual ~Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;

  /// The tightest box that is cheap to find; never too small.
  virtual Bounds bounds() const = 0;

  /// Appends every hit of the whole line (t from −∞ to ∞) with the shape, in ascending t, to
  /// `hits`, leaving what is in it. For a solid the hits alternate between entering and leaving
  /// (a tangent line may give none, or two that are equal); a line inside the surface gives none.
  virtual void intersect(const Ray& ray, Hits& hits) const = 0;

  /// Whether some hit has t_min < t < t_max. The default asks intersect().
  virtual bool occludes(const Ray& ray, double t_min, double t_max) const;

  /// The same for many segments at once: blocked[i] = 1 where occludes(segments.ray(i), 0, t_max),
  /// bit for bit; where not, blocked[i] is left as it is. The default asks one after the other.
  virtual void occlude(const SegmentBlock& segments, double t_max,
                       SegmentBlock::Mask& blocked) const;

  /// Whether the surface surely stays out of the open box; false where that is not known. The
  /// default looks at bounds().
  virtual bool avoids(const Bounds& box) const { return !bounds().overlaps(box); }

  /// Whether the surface encloses a volume: such shapes may be used in CSG.
  virtual bool solid() const = 0;

  /// Whether `point` lies strictly inside the solid; false for open surfaces.
  virtual bool contains(const Vec3& point) const = 0;

  /// Whether the solid reaches to infinity, so that lines begin and end inside it: a room seen from
  /// inside is all space but the room's air.
  virtual bool unbounded() const { return false; }

  /// Hit::face is less than this.
  virtual std::uint32_t face_count() const { return 1; }

  /// Area of the surface in m², where a formula for it is known.
  virtual std::optional<double> area() const { return std::nullopt; }

  /// Triangles with sides no longer than about `max_edge` (m) that together have the area of the
  /// surface (each curved piece is scaled so that they do): how an emitter is cut into elements.
  /// Pieces that meet at an angle share no points. Nothing where the shape has no such form.
  /// Throws InputError where max_edge is not greater than 0 or makes more than 10⁶ triangles.
  virtual std::optional<TriangleSoup> triangulate(double max_edge) const;

  /// What the shape was made from, such that a shape made from it has the same hits.
  virtual ShapeDescription describe() const = 0;

  virtual std::size_t part_count() const { return 1; }
  virtual Bounds part_bounds(std::size_t /*part*/) const { return bounds(); }
  /// As intersect() and occludes(), for one part alone.
  virtual void intersect_part(std::size_t /*part*/, const Ray& ray, Hits& hits) const {
    intersect(ray, hits);
  }
  virtual bool part_occludes(std::size_t /*part*/, const Ray& ray, double t_min,
                             double t_max) const {
    return occludes(ray, t_min, t_max);
  }

 protected:
  Shape() = default;
};

}  // namespace isolux
