#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/triangle_mesh.h"
#include "isolux/scene/scene.h"

// Native → another format → native.

namespace isolux {

/// Every kind of surface that both MGF and Radiance have.
inline std::vector<std::shared_ptr<const Shape>> simple_shapes() {
  const auto turned = [](std::shared_ptr<const Shape> shape) {
    return std::make_shared<Reversed>(std::move(shape));
  };
  const Vec3 a{0.1, 0.2, 0.3}, b{1.1, -0.4, 2.3};
  const std::vector<Vec3> outline{{0, 0, 1}, {3, 0, 1}, {3, 1, 1}, {1, 1, 1}, {0, 4, 1}};
  return {
      std::make_shared<Sphere>(a, 0.7),
      turned(std::make_shared<Sphere>(a, 0.7)),
      std::make_shared<Cylinder>(a, b, 0.3, false),
      turned(std::make_shared<Cylinder>(a, b, 0.3, false)),
      std::make_shared<Frustum>(a, b, 0.3, 0.1, false),
      turned(std::make_shared<Frustum>(a, b, 0.3, 0, false)),
      std::make_shared<Disk>(a, b, 0.4, 0.1),
      std::make_shared<Disk>(a, b, 1.0 / 3),
      std::make_shared<Parallelogram>(a, Vec3{1, 0, 1}, Vec3{0, 3, 1}),
      std::make_shared<Polygon>(outline),
      std::make_shared<Polygon>(
          outline, std::vector<std::vector<Vec3>>{{{0.2, 0.2, 1}, {0.6, 0.2, 1}, {0.2, 0.8, 1}},
                                                  {{2, 0.2, 1}, {2.5, 0.3, 1}, {2.2, 0.7, 1}}}),
      std::make_shared<TriangleMesh>(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                     std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}),
  };
}

/// Each shape twice: in one of two materials, and as a black light.
inline Scene varied_scene(const std::vector<std::shared_ptr<const Shape>>& shapes) {
  Scene scene;
  scene.materials = {{"grey", gray(1.0 / 3)}, {"red", {0.7, 0.1, 0.05}}, {"black", {}}};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Sides sides = shapes[i]->solid() ? Sides::front : Sides::both;
    const auto number = std::to_string(i);
    scene.objects.push_back(
        {"s" + number, shapes[i], static_cast<std::uint32_t>(i % 2), sides, {}});
    scene.objects.push_back({"lamp" + number, shapes[i], 2, Sides::front, {900, 700, 100.0 / 3}});
  }
  return scene;
}

/// Expects that colors differ by no more than 1e-6 of the largest channel.
inline void expect_same_color(const Rgb& a, const Rgb& b) {
  const double slack = 1e-6 * max_channel(a);
  EXPECT_NEAR(a.r, b.r, slack);
  EXPECT_NEAR(a.g, b.g, slack);
  EXPECT_NEAR(a.b, b.b, slack);
}

/// Expects the same objects, one by one.
inline void expect_same_objects(const Scene& before, const Scene& after) {
  ASSERT_EQ(after.objects.size(), before.objects.size());
  for (std::uint32_t i = 0; i < before.objects.size(); ++i) {
    const Object &x = before.objects[i], &y = after.objects[i];
    SCOPED_TRACE(x.name);
    EXPECT_EQ(x.name, y.name);
    EXPECT_EQ(x.sides, y.sides);
    // A mesh of one triangle comes back as a polygon; all else is of its own kind.
    const auto kind = x.shape->describe().kind;
    EXPECT_EQ(kind == "mesh" ? "polygon" : kind, y.shape->describe().kind);
    const Bounds p = x.shape->bounds(), q = y.shape->bounds();
    EXPECT_LT(std::max(distance(p.lower, q.lower), distance(p.upper, q.upper)), 1e-9);
    const double area = surface_area(*x.shape).value();
    EXPECT_NEAR(area, surface_area(*y.shape).value(), 1e-9 * area);
    Hits there, here;
    for (const Vec3& d : {Vec3{1, 0.2, 0.1}, Vec3{0, 0.1, 1}, Vec3{-0.3, 1, 0.2}}) {
      x.shape->intersect({p.center() + Vec3{0.03, 0.02, 0.01}, d}, there);
      y.shape->intersect({p.center() + Vec3{0.03, 0.02, 0.01}, d}, here);
    }
    ASSERT_EQ(there.size(), here.size());
    for (std::size_t k = 0; k < here.size(); ++k) {
      EXPECT_LT(distance(there[k].normal, here[k].normal), 1e-9);
    }
    expect_same_color(before.material_of(i).reflectance, after.material_of(i).reflectance);
    expect_same_color(x.exitance, y.exitance);
    EXPECT_NEAR(luminous_flux(x), luminous_flux(y), 1e-6 * luminous_flux(x));
  }
}

/// Where a line meets any of the objects, in ascending t.
inline Hits hits_of_all(const Scene& scene, const Ray& ray) {
  Hits hits;
  for (const Object& object : scene.objects) object.shape->intersect(ray, hits);
  std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return hits;
}

inline double total_flux_of(const Scene& scene) {
  double flux = 0;
  for (const Object& object : scene.objects) flux += luminous_flux(object);
  return flux;
}

/// m²; nothing where that of an object is not known.
inline std::optional<double> total_area_of(const Scene& scene) {
  double area = 0;
  for (const Object& object : scene.objects) {
    const auto known = surface_area(*object.shape);
    if (!known) return known;
    area += *known;
  }
  return area;
}

}  // namespace isolux
