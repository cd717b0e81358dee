#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "covered.h"
#include "isolux/discretization/split_points.h"
#include "support/scenes.h"

namespace isolux {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A lamp's shade: an outer sheet, and the insides of two cones just within it, which meet at a
/// blunt fold.
TEST(CoverOfCloseSurfaces, ShadesOfTwoSheetsAreCoveredInside) {
  const auto cone = [](double from, double to, double r0, double r1) {
    return fmt::format("cone: {{from: [0, 0, {}], to: [0, 0, {}], radii: [{}, {}], open: true}}",
                       from, to, r0, r1);
  };
  const Scene scene = scene_of(fmt::format(
      "materials: {{tan: {{reflectance: 0.2}}, white: {{reflectance: 0.8}}}}\nobjects:\n"
      "  - {{shape: {{box: {{lower: [-2, -2, -2], upper: [2, 2, 2], inward: true}}}}, material: "
      "tan}}\n"
      "  - {{shape: {{reversed: {{{}}}}}, material: white}}\n"
      "  - {{shape: {{reversed: {{{}}}}}, material: white}}\n"
      "  - {{shape: {{{}}}, material: tan}}\n  - {{shape: {{{}}}, material: tan}}\n",
      cone(0.05, 0.025, 0.02, 0.045), cone(0.025, -0.04, 0.045, 0.07),
      cone(0.05, 0.025, 0.0225, 0.0475), cone(0.025, -0.04, 0.0475, 0.0725)));
  const RayCaster rays(scene);
  const Triangulation mesh = covered(rays, 0.3);
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  double inside = 0;
  for (const Triangle& t : mesh.triangles()) {
    const Vertex& v = mesh.vertex(t.vertices[0]);
    const bool inward = v.normal.x * v.position.x + v.normal.y * v.position.y < 0;
    if (t.alive && inward && luminance(v.reflectance) > 0.5) inside += t.area;
  }
  const double area = kPi * (0.065 * std::hypot(0.025, 0.025) + 0.115 * std::hypot(0.025, 0.065));
  EXPECT_NEAR(inside, area, 0.05 * area) << "facets of hollow surfaces are a little smaller";
}

/// A plate hangs a hair below a ceiling: the ceiling is covered up to its edges.
TEST(CoverOfCloseSurfaces, CeilingsAreCoveredUpToWhatHangsAHairBelow) {
  const Scene scene = scene_of(
      "materials: {m: {reflectance: 0.5}}\nobjects:\n"
      "  - {shape: {box: {lower: [-2, -2, 0], upper: [2, 2, 2.5], inward: true}}, material: m}\n"
      "  - {shape: {parallelogram: {corner: [-0.4, -0.4, 2.49924], u: [0, 0.8, 0], v: [0.8, 0, "
      "0]}}, material: m, sides: front, emission: {exitance: 100}}\n");
  const RayCaster rays(scene);
  const Triangulation mesh = covered(rays, 0.4);
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  double ceiling = 0;
  for (const Triangle& t : mesh.triangles()) {
    if (t.alive && t.normal.z < -0.9 && mesh.vertex(t.vertices[0]).surface.object == 0) {
      ceiling += t.area;
    }
  }
  EXPECT_GT(ceiling, 0.995 * (16 - 0.64));
  EXPECT_LT(ceiling, 1.005 * 16);
}

/// Edges of a thin-walled tube are split on its outside, not on the wall's other face, though that
/// is nearer to their middles than the arc over them.
TEST(CoverOfCloseSurfaces, APointStandsWhereABallTouchesTheFloor) {
  const Scene scene = scene_of(
      "materials: {m: {reflectance: 0.5}}\nobjects: "
      "[{shape: {box: {lower: [0, 0, 0], upper: [1, 1, 1], inward: true}}, material: m}, "
      "{shape: {sphere: {center: [0.37, 0.61, 0.1], radius: 0.1}}, material: m}]");
  const RayCaster rays(scene);
  for (const double spacing : {0.1, 0.05}) {
    SCOPED_TRACE(spacing);
    const Triangulation mesh = covered(rays, spacing);
    EXPECT_THAT(mesh.validate(), testing::IsEmpty());
    double nearest = spacing;
    for (const Vertex& v : mesh.vertices()) {
      if (v.position.z < 1e-9) {
        nearest = std::min(nearest, std::hypot(v.position.x - 0.37, v.position.y - 0.61));
      }
    }
    EXPECT_LT(nearest, 0.005);  // where the gap is a tenth of a millimetre
  }
}

TEST(CoverOfCloseSurfaces, EdgesOverThinWallsAreSplitOnTheSideOfTheirEnds) {
  const double outside = 1, inside = 0.93;
  const Scene scene = scene_of(fmt::format(
      "materials: {{m: {{reflectance: 0.5}}}}\nobjects:\n"
      "  - {{shape: {{box: {{lower: [-2, -2, -2], upper: [2, 2, 2], inward: true}}}}, material: "
      "m}}\n"
      "  - {{shape: {{cylinder: {{from: [0, 0, -1], to: [0, 0, 1], radius: {}, open: true}}}}, "
      "material: m}}\n"
      "  - {{shape: {{cylinder: {{from: [0, 0, -1], to: [0, 0, 1], radius: {}, open: true}}}}, "
      "material: m}}\n",
      outside, inside));
  const RayCaster rays(scene);
  Triangulation mesh({3, 1e-9, 0.77}, scene.bounds());
  std::vector<VertexId> ids;
  for (const double angle : {0.0, 0.75}) {  // the chord's middle lies at 0.9305 m
    for (const double z : {0.3, -0.3}) {
      Vertex v;
      v.normal = {std::cos(angle), std::sin(angle), 0};
      v.position = v.gather_point = v.normal * outside + Vec3{0, 0, z};
      v.surface = {1, 0};
      v.reflectance = gray(0.5);
      ids.push_back(mesh.restore_vertex(v));
    }
  }
  mesh.restore_triangle({ids[0], ids[1], ids[2]}, {}, {}, false);
  mesh.restore_triangle({ids[1], ids[3], ids[2]}, {}, {}, false);
  const auto middle = point_over_edge(mesh, rays, ids[1], ids[2]);
  ASSERT_TRUE(middle);
  EXPECT_NEAR(std::hypot(middle->position.x, middle->position.y), outside, 1e-9);
}

/// A wall that the ends of slats stand on, none of whose creases is as long as the wall's points
/// are apart.
TEST(CoverOfCloseSurfaces, WallsAreCoveredBesideShortCreases) {
  std::string text =
      "materials: {m: {reflectance: 0.5}}\nobjects:\n  - {shape: {box: {lower: [0, 0, 0], "
      "upper: [4, 4, 4], inward: true}}, material: m}\n";
  constexpr int kSlats = 12;
  for (int k = 0; k < kSlats; ++k) {
    text += fmt::format(
        "  - {{shape: {{box: {{lower: [1.5, 0, {0}], upper: [1.6, 1, {1}]}}}}, material: m}}\n",
        1 + 0.08 * k, 1.004 + 0.08 * k);
  }
  const Scene scene = scene_of(text);
  const RayCaster rays(scene);
  const Triangulation mesh = covered(rays, 0.4);
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  double wall = 0;
  for (const Triangle& t : mesh.triangles()) {
    if (t.alive && mesh.vertex(t.vertices[0]).surface.object == 0 && t.normal.y > 0.9) {
      wall += t.area;
    }
  }
  EXPECT_NEAR(wall, 16 - kSlats * 0.1 * 0.004, 0.01);
}

}  // namespace
}  // namespace isolux
