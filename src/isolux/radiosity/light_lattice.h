#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "isolux/core/color.h"
#include "isolux/scene/scene.h"

namespace isolux {

/// A flat convex piece that is measured by the closed form: a triangle, or a parallelogram.
struct Piece {
  std::array<Vec3, 4> corners;
  std::size_t corner_count;
  Vec3 normal;
  std::uint32_t first, end;  ///< its triangles of the lattice
  /// How far the curved surface that it stands for may be off it, m: a receiver on that same
  /// surface is no more than this before the piece, and must not see it.
  double off = 0;

  /// How far before the piece, and whatever surface it stands for, the point is, m.
  double before(const Vec3& point) const { return dot(point - corners[0], normal) - off; }
  std::span<const Vec3> polygon() const { return {corners.data(), corner_count}; }
};

struct LatticeTriangle {
  std::array<std::uint32_t, 3> points;
  std::array<std::uint32_t, 3> lines;  ///< line k joins points k and k + 1
  Vec3 normal;
  double area;
};

/// Between two points of the lattice; where the surface is curved it rises over the chord by
/// 4 s (1 − s) rise.
struct LatticeLine {
  std::uint32_t from, to;
  Vec3 rise;
};

/// A light that is a ball, m.
struct Ball {
  Vec3 center;
  double radius;
  double lift;  ///< by which points are lifted off its surface
};

/// A light's surface as points, lines between them and triangles, in flat pieces.
///
/// Of a ball each receiver sees another cap: its lattice lies in the unit disk z = 0 that stands
/// for any of these (BallView), and it has no pieces.
struct LightLattice {
  std::uint32_t object = 0;  ///< the light in the scene
  Rgb exitance;
  std::optional<Ball> ball;
  /// One standard deviation, relative, from flat pieces that stand for a curved surface.
  double flatness = 0;
  Bounds bounds;  ///< of the points on the surface
  std::vector<Piece> pieces;
  std::vector<Vec3> points;  ///< a hair above the surface, m; of a ball in the unit disk
  std::vector<LatticeLine> lines;
  std::vector<LatticeTriangle> triangles;
  std::vector<std::uint32_t> first_look, second_look;  ///< the points, in two portions

  Vec3 at(const LatticeLine& line, double s) const {
    return points[line.from] + (points[line.to] - points[line.from]) * s +
           line.rise * (4 * s * (1 - s));
  }
};

/// Cuts the surface of the scene's object of that index into pieces with their lattices, `lift` (m)
/// above it. The shape is one that can be cut into triangles.
std::shared_ptr<const LightLattice> lattice_of(const Scene& scene, std::uint32_t object,
                                               double lift);

}  // namespace isolux
