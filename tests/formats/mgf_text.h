#pragma once

#include <gtest/gtest.h>

#include <string>

#include "isolux/core/error.h"
#include "isolux/formats/mgf/mgf.h"

namespace isolux {

inline SceneFile read_text(const std::string& text) { return parse_mgf(text, "test.mgf"); }

/// The only object of a text.
inline Object only_object(const std::string& text) {
  const SceneFile file = read_text(text);
  EXPECT_EQ(file.scene.objects.size(), 1u);
  return file.scene.objects.at(0);
}

/// What reading the text is refused with; empty where it is not.
inline std::string mgf_refusal(const std::string& text) {
  try {
    read_text(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// Vertices o (at the origin), x, y, z (at 1 on the axes; z has its normal along its own) and xy,
/// at (1, 1, 0); ten lines.
inline const std::string kVertices =
    "v o =\n"
    "v x =\n p 1 0 0\n"
    "v y =\n p 0 1 0\n"
    "v z =\n p 0 0 1\n n 0 0 1\n"
    "v xy =\n p 1 1 0\n";

inline Hits hits_along(const Shape& shape, const Vec3& from, const Vec3& direction) {
  Hits hits;
  shape.intersect({from, direction}, hits);
  return hits;
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_LT(distance(a, b), tolerance) << '(' << a.x << ", " << a.y << ", " << a.z << ") against ("
                                       << b.x << ", " << b.y << ", " << b.z << ')';
}

/// The volume that a shape's triangles enclose, negative where they face inward, m³.
inline double volume_of(const Shape& shape, double max_edge = 100) {
  const TriangleSoup soup = shape.triangulate(max_edge).value();
  double volume = 0;
  for (const auto& [a, b, c] : soup.triangles) {
    volume += dot(soup.points[a], cross(soup.points[b], soup.points[c])) / 6;
  }
  return volume;
}

}  // namespace isolux
