#pragma once

#include <array>
#include <cstdint>
#include <memory>
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

/// A light's surface as points, lines between them and triangles, in flat pieces.
struct LightLattice {
  Rgb exitance;
  /// One standard deviation, relative, from flat pieces that stand for a curved surface.
  double flatness = 0;
  Bounds bounds;
  std::vector<Piece> pieces;
  std::vector<Vec3> points;  ///< a hair above the surface
  std::vector<LatticeLine> lines;
  std::vector<LatticeTriangle> triangles;
  std::vector<std::uint32_t> first_look, second_look;  ///< the points, in two portions

  Vec3 at(const LatticeLine& line, double s) const {
    return points[line.from] + (points[line.to] - points[line.from]) * s +
           line.rise * (4 * s * (1 - s));
  }
};

/// Cuts an object's surface into pieces with their lattices, `lift` (m) above it. The shape is one
/// that can be cut into triangles.
std::shared_ptr<const LightLattice> lattice_of(const Object& object, double lift);

}  // namespace isolux
