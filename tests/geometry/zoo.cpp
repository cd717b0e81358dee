#include "geometry/zoo.h"

#include <numbers>

#include "isolux/geometry/blob.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/implicit.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux {
namespace {

Level sphere_level(Vec3 c, double r) {
  return [=](const Vec3& p) { return distance(p, c) - r; };
}

Level box_level(Vec3 lower, Vec3 upper) {
  return [=](const Vec3& p) {
    const Vec3 q = max(lower - p, p - upper);
    return std::max({q.x, q.y, q.z});
  };
}

Level plane_level(Vec3 anchor, Vec3 normal) {
  return [=, n = normalized(normal)](const Vec3& p) { return dot(p - anchor, n); };
}

Level frustum_level(Vec3 start, Vec3 end, double r0, double r1, bool capped) {
  return [=](const Vec3& p) {
    const double l = distance(start, end);
    const Vec3 axis = (end - start) / l;
    const double z = dot(p - start, axis);
    const double side =
        (length(p - start - axis * z) - (r0 + (r1 - r0) * z / l)) * l / std::hypot(l, r1 - r0);
    return capped ? std::max({side, -z, z - l}) : side;
  };
}

Level torus_level(Vec3 c, Vec3 axis, double major, double minor) {
  return [=, n = normalized(axis)](const Vec3& p) {
    const double z = dot(p - c, n);
    return std::hypot(length(p - c - n * z) - major, z) - minor;
  };
}

/// To first order the distance from the surface; beyond all balls just positive.
Level blob_level(double threshold, std::vector<BlobBall> balls) {
  return [=](const Vec3& p) {
    double field = 0;
    Vec3 slope;
    for (const BlobBall& ball : balls) {
      const Vec3 away = p - ball.center;
      const double q = 1 - length_squared(away) / (ball.radius * ball.radius);
      if (!(q > 0)) continue;
      field += ball.strength * q * q;
      slope += away * (-4 * ball.strength * q / (ball.radius * ball.radius));
    }
    const double steepness = length(slope);
    return steepness > 0 ? (threshold - field) / steepness : field > threshold ? -1.0 : 1.0;
  };
}

Level both(Level a, Level b) {
  return [=](const Vec3& p) { return std::max(a(p), b(p)); };
}

Level outside(Level a) {
  return [=](const Vec3& p) { return -a(p); };
}

Level either(Level a, Level b) { return outside(both(outside(a), outside(b))); }

std::vector<Vec3> box_edges(Vec3 lower, Vec3 upper) {
  std::vector<Vec3> points;
  for (int i = 0; i < 27; ++i) {
    const Vec3 w = Vec3{i % 3 * 0.5, i / 3 % 3 * 0.5, i / 9 * 0.5};
    if ((w.x != 0.5) + (w.y != 0.5) + (w.z != 0.5) < 2) continue;
    const Vec3 s = upper - lower;
    points.push_back(lower + Vec3{w.x * s.x, w.y * s.y, w.z * s.z});
  }
  return points;
}

void add_frustum(std::vector<Specimen>& zoo, const std::string& name, Vec3 start, Vec3 end,
                 double r0, double r1) {
  std::vector<Vec3> edges = rim(start, end - start, r0);
  for (const Vec3& p : rim(end, end - start, r1)) edges.push_back(p);
  zoo.push_back({"Open" + name, std::make_shared<Frustum>(start, end, r0, r1, false),
                 frustum_level(start, end, r0, r1, false), edges});
  zoo.push_back({"Capped" + name, std::make_shared<Frustum>(start, end, r0, r1, true),
                 frustum_level(start, end, r0, r1, true), edges});
}

ShapePtr octahedron(bool inside_out) {
  const std::vector<Vec3> p = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<std::uint32_t, 3>> t;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t x = i & 1, y = 2 + (i >> 1 & 1), z = 4 + (i >> 2);
    const bool even = (x + y + z) % 2 == 0;
    t.push_back(even != inside_out ? std::array{x, y, z} : std::array{x, z, y});
  }
  return std::make_shared<TriangleMesh>(p, t);
}

double octahedron_level(const Vec3& p) {
  return (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) - 1) / std::sqrt(3.0);
}

void add_basic(std::vector<Specimen>& zoo) {
  const auto sphere = std::make_shared<Sphere>(Vec3{1, 2, 3}, 1.5);
  zoo.push_back({"Sphere", sphere, sphere_level({1, 2, 3}, 1.5)});
  const Vec3 lower{-1, 0, 2}, upper{1, 3, 2.5};
  const auto box = std::make_shared<Box>(lower, upper);
  zoo.push_back({"Box", box, box_level(lower, upper), box_edges(lower, upper)});
  zoo.push_back({"Room", std::make_shared<Complement>(box), outside(box_level(lower, upper)),
                 box_edges(lower, upper)});
  zoo.push_back({"CylinderAlongZ", std::make_shared<Cylinder>(Vec3{}, Vec3{0, 0, 2}, 0.5, true),
                 frustum_level({}, {0, 0, 2}, 0.5, 0.5, true), rim({}, {0, 0, 1}, 0.5)});
  add_frustum(zoo, "Cylinder", {1, 0, -1}, {2, 2, 1}, 0.7, 0.7);
  add_frustum(zoo, "Frustum", {1, 0, -1}, {2, 2, 1}, 0.7, 1.4);
  add_frustum(zoo, "Cone", {1, 0, -1}, {-2, 2, 0}, 1.2, 0);
  add_frustum(zoo, "FlatCone", {1, 0, 0}, {1, 0, 0.1}, 0, 3);
  zoo.push_back(
      {"Bubble", std::make_shared<Reversed>(sphere), outside(sphere_level({1, 2, 3}, 1.5))});
  const double wide = 0.7, thin = 0.02;
  for (const double minor : {wide, thin}) {
    zoo.push_back({minor == thin ? "ThinTorus" : "Torus",
                   std::make_shared<Torus>(Vec3{1, -1, 0}, Vec3{1, 2, 2}, 2, minor),
                   torus_level({1, -1, 0}, {1, 2, 2}, 2, minor)});
  }
}

void add_blobs(std::vector<Specimen>& zoo) {
  const auto add = [&](const std::string& name, double threshold, std::vector<BlobBall> balls) {
    zoo.push_back({name, std::make_shared<Blob>(threshold, balls), blob_level(threshold, balls)});
  };
  const std::vector<BlobBall> four = {
      {{-0.9, 0, 0}, 1, 1}, {{0.9, 0, 0}, 1, 1}, {{0, 0, -0.9}, 1, 1}, {{0, 0, 0.9}, 1, 1}};
  add("BlobOfBalls", 0.1, four);
  add("BlobApart", 0.6, four);
  add("BlobWithDent", 0.3, {{{1, 2, 3}, 2, 1.5}, {{2, 2, 3.5}, 1, -2}, {{0, 1, 3}, 1.5, 0.7}});
}

/// To first order the distance from the surface.
Level implicit_level(const Expression& f, Vec3 lower, Vec3 upper) {
  return [=, box = box_level(lower, upper)](const Vec3& p) {
    double value = 0;
    Vec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<Dual<double>, 3> variables{{{p.x}, {p.y}, {p.z}}};
      variables[axis].slope = 1;
      const Dual<double> result = f(variables);
      value = result.value, gradient[axis] = result.slope;
    }
    const double steepness = length(gradient);
    return std::max(steepness > 0 ? value / steepness : value, box(p));
  };
}

void add_implicit(std::vector<Specimen>& zoo) {
  const auto add = [&](const std::string& name, const char* text, Vec3 lower, Vec3 upper) {
    const Expression f(text);
    zoo.push_back({name, std::make_shared<Implicit>(f, lower, upper),
                   implicit_level(f, lower, upper), box_edges(lower, upper)});
  };
  add("ImplicitBall", "(x - 1)^2 + (y - 2)^2 + (z - 3)^2 - 2.25", {-1, 0, 1}, {3, 4, 4});
  add("Gyroid", "sin(2*x)*cos(2*y) + sin(2*y)*cos(2*z) + sin(2*z)*cos(2*x)", {-2, -2, -1},
      {2, 1, 2});
  add("TangleCube", "x^4 - 5*x^2 + y^4 - 5*y^2 + z^4 - 5*z^2 + 11.8", {-3, -3, -3}, {3, 3, 3});
  add("Kinked", "max(abs(x), abs(y), abs(z)) + 0.3*sqrt(x^2 + y^2 + z^2) - 1", {-2, -2, -2},
      {2, 2, 2});
}

void add_flat(std::vector<Specimen>& zoo) {
  const Vec3 c{1, 2, 3}, n{1, -2, 0.5};
  zoo.push_back({"Disk", std::make_shared<Disk>(c, n, 2), plane_level(c, n)});
  zoo.push_back({"Annulus", std::make_shared<Disk>(c, n, 2, 1.2), plane_level(c, n)});
  const Vec3 u{1, 1, 0}, v{-0.5, 2, 1};
  zoo.push_back({"Parallelogram",
                 std::make_shared<Parallelogram>(c, u, v),
                 plane_level(c, cross(u, v)),
                 {c, c + u, c + v, c + u * 0.5}});
  const std::vector<Vec3> l = {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1, 1, 1}, {1, 3, 1}, {0, 3, 1}};
  zoo.push_back({"Polygon", std::make_shared<Polygon>(l), plane_level({0, 0, 1}, {0, 0, 1}), l});
  const std::vector<std::vector<Vec3>> holes = {{{0.2, 0.2, 1}, {0.8, 0.2, 1}, {0.5, 2, 1}}};
  zoo.push_back(
      {"Frame", std::make_shared<Polygon>(l, holes), plane_level({0, 0, 1}, {0, 0, 1}), l});
}

void add_composed(std::vector<Specimen>& zoo) {
  const Vec3 lower{-1, -1, -1}, upper{1, 1, 1};
  const auto box = std::make_shared<Box>(lower, upper);
  const auto ball = std::make_shared<Sphere>(Vec3{1, 1, 0.5}, 0.9);
  const Level b = box_level(lower, upper), s = sphere_level({1, 1, 0.5}, 0.9);
  const auto make = [](CsgOperation operation, ShapePtr x, ShapePtr y) {
    return std::make_shared<Csg>(operation, x, y);
  };
  zoo.push_back({"Union", make(CsgOperation::unite, box, ball), either(b, s)});
  zoo.push_back({"Intersection", make(CsgOperation::intersect, box, ball), both(b, s)});
  const auto bitten = make(CsgOperation::subtract, box, ball);
  zoo.push_back({"Difference", bitten, both(b, outside(s)), box_edges(lower, upper)});
  const auto rod = std::make_shared<Cylinder>(Vec3{-1, -3, 0}, Vec3{-0.5, 3, 0}, 0.3, true);
  const Level r = frustum_level({-1, -3, 0}, {-0.5, 3, 0}, 0.3, 0.3, true);
  zoo.push_back({"Nested", make(CsgOperation::unite, bitten, rod), either(both(b, outside(s)), r)});
  zoo.push_back({"RoomWithRod", make(CsgOperation::unite, std::make_shared<Complement>(box), rod),
                 either(outside(b), r)});
  Affine skew = Affine::rotate({1, 2, 3}, 0.7) * Affine::scale({1.5, -0.8, 1});
  skew.linear[0].y += 0.4;
  skew.translation = {1, 2, 3};
  const auto through = [inverse = *skew.inverse()](Level level) {
    return [=](const Vec3& p) { return level(inverse.point(p)); };
  };
  zoo.push_back(
      {"Instance", std::make_shared<Instance>(bitten, skew), through(both(b, outside(s)))});
  const std::vector<Vec3> corners = {{1, 0, 0}, {0, -1, 0}, {0.5, 0.5, 0}, {0, 0.5, -0.5}};
  zoo.push_back({"Mesh", octahedron(false), octahedron_level, corners});
  zoo.push_back({"MeshRoom", octahedron(true), outside(octahedron_level), corners});
  zoo.push_back({"MeshInstance", std::make_shared<Instance>(octahedron(false), skew),
                 through(octahedron_level)});
}

}  // namespace

std::vector<Vec3> rim(Vec3 center, Vec3 normal, double r) {
  const Frame frame(normalized(normal));
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    const double a = i * std::numbers::pi / 4;
    points.push_back(center + frame.to_world({r * std::cos(a), r * std::sin(a), 0}));
  }
  return points;
}

const std::vector<Specimen>& zoo() {
  static const std::vector<Specimen> specimens = [] {
    std::vector<Specimen> all;
    add_basic(all);
    add_blobs(all);
    add_implicit(all);
    add_flat(all);
    add_patches(all);
    add_swept(all);
    add_composed(all);
    return all;
  }();
  return specimens;
}

Vec3 random_direction(Random& random) {
  const double z = 2 * random.uniform() - 1, angle = 2 * std::numbers::pi * random.uniform();
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Ray random_line(Random& random, const Vec3& center, double radius, double distance) {
  const Vec3 d = random_direction(random);
  const Frame frame(d);
  const double r = radius * std::sqrt(random.uniform());
  const double angle = 2 * std::numbers::pi * random.uniform();
  const Vec3 middle = center + frame.to_world({r * std::cos(angle), r * std::sin(angle), 0});
  return {middle - d * distance, d};
}

}  // namespace isolux
