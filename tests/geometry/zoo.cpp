#include "geometry/zoo.h"

#include <numbers>

#include "isolux/geometry/blob.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/curve.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/prism.h"
#include "isolux/geometry/reversed.h"
#include "isolux/geometry/revolution.h"
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

using Outline = std::vector<Vec3>;

/// The distance of (x, y) from the outlines, negative within an odd number of them.
double outline_distance(const std::vector<Outline>& outlines, double x, double y) {
  const Vec3 p{x, y, 0};
  double least = 1e9;
  bool inside = false;
  for (const Outline& ring : outlines) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec3 a{ring[i].x, ring[i].y, 0};
      const Vec3 b{ring[(i + 1) % ring.size()].x, ring[(i + 1) % ring.size()].y, 0};
      const double t = std::clamp(dot(p - a, b - a) / length_squared(b - a), 0.0, 1.0);
      least = std::min(least, distance(p, a + (b - a) * t));
      if ((a.y > y) != (b.y > y)) inside ^= x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
    }
  }
  return inside ? -least : least;
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

std::vector<Vec3> rim(Vec3 center, Vec3 normal, double r) {
  const Frame frame(normalized(normal));
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    const double a = i * std::numbers::pi / 4;
    points.push_back(center + frame.to_world({r * std::cos(a), r * std::sin(a), 0}));
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

/// Of a prism over the plane z = 1.
Level prism_level(std::vector<Outline> outlines, Vec3 along, PrismTop top) {
  return [=](const Vec3& p) {
    const double z = (p.z - 1) / along.z, angle = top.twist * z * std::numbers::pi / 180;
    const double kx = 1 + (top.scale[0] - 1) * z, ky = 1 + (top.scale[1] - 1) * z;
    const double x = (p.x - top.center.x - along.x * z) / kx;
    const double y = (p.y - top.center.y - along.y * z) / ky;
    const double c = std::cos(angle), s = std::sin(angle);
    const double side =
        outline_distance(outlines, top.center.x + c * x + s * y, top.center.y + c * y - s * x);
    return std::max({side * std::min(kx, ky), 1 - p.z, p.z - 1 - along.z});
  };
}

void add_prisms(std::vector<Specimen>& zoo) {
  const Outline l = {{0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {1.1, 1, 1}, {1.1, 3, 1}, {0, 3, 1}};
  const Outline hole = {{0.2, 0.2, 1}, {0.8, 0.2, 1}, {0.5, 2, 1}};
  const auto add = [&](const std::string& name, const Vec3& along, PrismTop top) {
    Outline corners = l;
    corners.insert(corners.end(), hole.begin(), hole.end());
    top.center.z = 1;
    zoo.push_back({name, std::make_shared<Prism>(l, std::vector<Outline>{hole}, along, top),
                   prism_level({l, hole}, along, top), corners});
  };
  add("Prism", {0, 0, 1.5}, {});
  add("LeaningPrism", {0.7, -0.4, 1.5}, {});
  add("TaperedPrism", {0.7, -0.4, 1.5}, {{1, 1, 1}, {0.3, 0.3}});
  add("Steeple", {0, 0, 2}, {{1, 1, 1}, {0, 0}});
  add("RuledPrism", {0, 0, 2}, {{1, 1, 1}, {0.5, 1.5}});
  add("TwistedPrism", {0, 0, 2}, {{1, 1, 1}, {1, 1}, 200});
  add("LeaningTwistedPrism", {0.5, 0.2, 2}, {{0, 0, 1}, {0.4, 0.8}, -90});
  const Outline clockwise(l.rbegin(), l.rend());
  const Vec3 down{0, 0, -1.5};
  zoo.push_back({"PrismBelow", std::make_shared<Prism>(clockwise, std::vector<Outline>{}, down),
                 [l](const Vec3& p) {
                   return std::max({outline_distance({l}, p.x, p.y), p.z - 1, -0.5 - p.z});
                 }});
}

/// The signed distance in the half plane of a profile, r and z as x and y: from its outline with
/// its mirror image beyond the axis.
Level polygon_profile(std::vector<ProfilePoint> profile) {
  Outline outline;
  for (const auto& [r, z] : profile) outline.push_back({r, z, 0});
  if (profile.front()[0] == 0 && profile.back()[0] == 0) {
    for (std::size_t i = profile.size() - 1; i-- > 1;) {
      outline.push_back({-profile[i][0], profile[i][1], 0});
    }
  }
  return [=](const Vec3& p) { return outline_distance({outline}, p.x, p.y); };
}

/// The same for a curve (x, 0, z) with its inside on the left: by the nearest of many places on it,
/// improved by Newton's method.
Level curved_profile(std::vector<CurveArc> arcs) {
  return [=](const Vec3& q) {
    const Vec3 p{q.x, 0, q.y};
    double nearest = 1e9, level = 0;
    for (const CurveArc& arc : arcs) {
      const auto at = [&](double u, int order) {
        const double v = 1 - u;
        const auto& [a, b, c, d] = arc;
        if (order == 0) {
          return a.p * (v * v * v) + b.p * (3 * v * v * u) + c.p * (3 * v * u * u) +
                 d.p * (u * u * u);
        }
        const Vec3 e = (b.p - a.p) * 3, f = (c.p - b.p) * 3, g = (d.p - c.p) * 3;
        if (order == 1) return e * (v * v) + f * (2 * v * u) + g * (u * u);
        return (f - e) * (2 * v) + (g - f) * (2 * u);
      };
      double best = 0;
      for (double u = 0; u <= 1; u += 1.0 / 64) {
        if (distance(at(u, 0), p) < distance(at(best, 0), p)) best = u;
      }
      for (int i = 0; i < 20; ++i) {
        const Vec3 away = at(best, 0) - p, slope = at(best, 1);
        best -= dot(away, slope) / (length_squared(slope) + dot(away, at(best, 2)));
        best = std::clamp(best, 0.0, 1.0);
      }
      const Vec3 away = p - at(best, 0), slope = at(best, 1);
      if (length(away) < nearest) {
        nearest = length(away);
        level = slope.z * away.x - slope.x * away.z > 0 ? nearest : -nearest;
      }
    }
    return level;
  };
}

/// Of a profile turned about the axis x = 1, y = 2, from x on.
Level revolution_level(Level profile, double degrees = 360) {
  return [=](const Vec3& p) {
    const double x = p.x - 1, y = p.y - 2, a = degrees * std::numbers::pi / 180;
    const double level = profile({std::hypot(x, y), p.z, 0});
    if (degrees == 360) return level;
    const double start = -y, end = std::cos(a) * y - std::sin(a) * x;
    return std::max(level, degrees <= 180 ? std::max(start, end) : std::min(start, end));
  };
}

void add_revolutions(std::vector<Specimen>& zoo) {
  const auto add = [&](const std::string& name, const std::vector<ProfilePoint>& profile,
                       const RevolutionForm& form, const Level& level) {
    std::vector<Vec3> edges;
    for (const auto& [r, z] : profile) {
      if (form.smooth) break;
      for (const Vec3& p : rim({1, 2, z}, {0, 0, 1}, r)) edges.push_back(p);
    }
    zoo.push_back({name + "Revolution",
                   std::make_shared<Revolution>(Vec3{1, 2, 0}, Vec3{0, 0, 1}, profile, form),
                   revolution_level(level, form.angle), edges});
  };
  const std::vector<ProfilePoint> ring = {{0.5, 0}, {1.5, 0}, {1.5, 0.3},
                                          {0.8, 1}, {1, 2},   {0.5, 2}};
  const std::vector<ProfilePoint> top = {{0, 0}, {1, 0.2}, {1, 1}, {0.3, 1}, {0, 2}};
  add("Ring", ring, {}, polygon_profile(ring));
  add("Top", top, {}, polygon_profile(top));
  add("ThirdRing", ring, {.angle = 120}, polygon_profile(ring));
  add("LargeTop", top, {.angle = 250}, polygon_profile(top));

  const auto curve_points = [](const std::vector<ProfilePoint>& profile) {
    std::vector<CurvePoint> points;
    for (const auto& [r, z] : profile) points.push_back({{r, 0, z}});
    return points;
  };
  const std::vector<ProfilePoint> pear = {{0, 0}, {0.9, 0.4}, {1, 1}, {0.4, 1.8}, {0, 2.2}};
  const auto mirrored = [](CurvePoint point) {
    point.p.x = -point.p.x;
    return point;
  };
  auto points = curve_points(pear);
  add("Pear", pear, {.smooth = true},
      curved_profile(curve_through(points, mirrored(points[1]), mirrored(points[3]))));
  add("HalfPear", pear, {.angle = 180, .smooth = true},
      curved_profile(curve_through(points, mirrored(points[1]), mirrored(points[3]))));
  const std::vector<ProfilePoint> tyre = {{1, 0}, {1.5, 0.2}, {1.6, 1}, {0.9, 1.1}, {0.7, 0.4}};
  points = curve_points(tyre);
  points.push_back(points.front());
  add("Tyre", tyre, {.smooth = true}, curved_profile(curve_through(points, points[4], points[1])));
  const std::vector<ProfilePoint> shade = {{0.3, 2}, {0.4, 1.5}, {1, 1.1}, {1.2, 0.4}};
  points = curve_points(shade);
  const Level turned_over = curved_profile(
      curve_through(points, straight_on(points[0], points[1]), straight_on(points[3], points[2])));
  add("Shade", shade, {.smooth = true, .open = true}, turned_over);
  add("Funnel", {{1.5, 2}, {0.5, 1}, {0.5, 0}}, {.angle = 300, .open = true},
      polygon_profile({{1.5, 2}, {0.5, 1}, {0.5, 0}, {9, 0}, {9, 2}}));
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

const std::vector<Specimen>& zoo() {
  static const std::vector<Specimen> specimens = [] {
    std::vector<Specimen> all;
    add_basic(all);
    add_blobs(all);
    add_flat(all);
    add_prisms(all);
    add_revolutions(all);
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
