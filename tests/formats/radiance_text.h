#pragma once

#include <gtest/gtest.h>

#include <string>

#include "isolux/core/error.h"
#include "isolux/formats/radiance/read_radiance.h"

namespace isolux {

/// A grey material of reflectance 0.5, "m"; five lines.
inline const std::string kGray = "void plastic m\n0\n0\n5 .5 .5 .5 0 0\n\n";

inline SceneFile read_radiance_text(const std::string& text) {
  return parse_radiance(text, "test.rad");
}

/// The objects of a text behind kGray.
inline std::vector<Object> gray_objects(const std::string& text) {
  return read_radiance_text(kGray + text).scene.objects;
}

/// What reading the text behind kGray is refused with; empty where it is not.
inline std::string radiance_refusal(const std::string& text) {
  try {
    read_radiance_text(kGray + text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

inline double total_area(const std::vector<Object>& objects) {
  double area = 0;
  for (const Object& object : objects) area += surface_area(*object.shape).value();
  return area;
}

inline Bounds bounds_of(const std::vector<Object>& objects) {
  Bounds box;
  for (const Object& object : objects) box.include(object.shape->bounds());
  return box;
}

inline double total_flux(const Scene& scene) {
  double flux = 0;
  for (const Object& object : scene.objects) flux += luminous_flux(object);
  return flux;
}

/// The volume that the triangles of all objects enclose, negative where they face inward, m³.
inline double volume_of(const std::vector<Object>& objects, double max_edge = 100) {
  double volume = 0;
  for (const Object& object : objects) {
    const TriangleSoup soup = object.shape->triangulate(max_edge).value();
    for (const auto& [a, b, c] : soup.triangles) {
      volume += dot(soup.points[a], cross(soup.points[b], soup.points[c])) / 6;
    }
  }
  return volume;
}

inline Hits hits_along(const Shape& shape, const Vec3& from, const Vec3& direction) {
  Hits hits;
  shape.intersect({from, direction}, hits);
  return hits;
}

inline void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_LT(distance(a, b), tolerance) << '(' << a.x << ", " << a.y << ", " << a.z << ") against ("
                                       << b.x << ", " << b.y << ", " << b.z << ')';
}

}  // namespace isolux
