#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "isolux/core/random.h"
#include "isolux/geometry/shape.h"

namespace isolux {

using ShapePtr = std::shared_ptr<const Shape>;

/// Negative inside, positive outside, zero on the surface (for open surfaces: on the surface that
/// they are cut from), changing by about 1 a metre.
using Level = std::function<double(const Vec3&)>;

struct Specimen {
  std::string name;
  ShapePtr shape;
  Level level;
  std::vector<Vec3> edges = {};  ///< points on edges, corners, tips
};

inline void PrintTo(const Specimen& s, std::ostream* out) { *out << s.name; }

/// At least one specimen of every shape, all of size 1 to 10 near the origin.
const std::vector<Specimen>& zoo();

/// Adds what is made from outlines, curves and grids: swept_zoo.cpp.
void add_swept(std::vector<Specimen>& zoo);

/// Adds what is made of curved patches: patch_zoo.cpp.
void add_patches(std::vector<Specimen>& zoo);

/// Points on a circle.
std::vector<Vec3> rim(Vec3 center, Vec3 normal, double r);

Vec3 random_direction(Random& random);

/// A line of the invariant measure of lines, given that it meets the sphere; unit direction, the
/// origin `distance` before the middle of the chord.
Ray random_line(Random& random, const Vec3& center, double radius, double distance);

inline Hits hits_of(const Shape& shape, const Ray& ray) {
  Hits hits;
  shape.intersect(ray, hits);
  return hits;
}

}  // namespace isolux
