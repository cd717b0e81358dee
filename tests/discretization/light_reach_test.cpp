#include "isolux/discretization/light_reach.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/discretization/cover.h"
#include "support/scenes.h"

namespace isolux {
namespace {

/// The mesh's area (m²) where `counts` says so of a triangle's first corner.
double area_of(const Triangulation& mesh, const auto& counts) {
  double area = 0;
  for (const Triangle& t : mesh.triangles()) {
    if (t.alive && counts(mesh.vertex(t.vertices[0]))) area += t.area;
  }
  return area;
}

Triangulation covered(const Scene& scene, double spacing) {
  const RayCaster rays(scene);
  Triangulation mesh({2.2 * spacing, 1e-9, 0.77}, scene.bounds());
  cover(mesh, rays, {spacing, 1});
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  return mesh;
}

/// Six sheets around [lower, upper]³, each with two sides.
std::string hollow_cube(double lower, double upper, const std::string& more = "") {
  const double d = upper - lower;
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double at : {lower, upper}) {
      double corner[3] = {lower, lower, lower}, u[3] = {0, 0, 0}, v[3] = {0, 0, 0};
      corner[axis] = at, u[(axis + 1) % 3] = d, v[(axis + 2) % 3] = d;
      text += fmt::format(
          "  - {{shape: {{parallelogram: {{corner: [{}], u: [{}], v: [{}]}}}}, material: m{}}}\n",
          fmt::join(corner, ", "), fmt::join(u, ", "), fmt::join(v, ", "), more);
    }
  }
  return text;
}

constexpr char kMaterial[] = "materials: {m: {reflectance: 0.5}}\n";
constexpr char kLamp[] =
    "  - {shape: {sphere: {center: [0.3, 0.3, 0.8], radius: 0.05}}, material: m, emission: "
    "{exitance: 100}}\n";

TEST(LightReach, NeitherTheOuterSidesOfARoomNorTheInsideOfAClosedBoxAreCovered) {
  const Scene scene = scene_of(kMaterial + std::string("objects:\n") + hollow_cube(0, 1) + kLamp +
                               hollow_cube(0.5, 0.7));
  const Triangulation mesh = covered(scene, 0.1);
  const Vec3 center{0.6, 0.6, 0.6};
  const auto in_box = [&](const Vertex& v) {
    const Vec3 d = v.position - center;
    return std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < 0.11;
  };
  EXPECT_NEAR(area_of(mesh, in_box), 6 * 0.04, 1e-3);
  EXPECT_EQ(
      area_of(mesh,
              [&](const Vertex& v) { return in_box(v) && dot(v.normal, v.position - center) < 0; }),
      0);
  EXPECT_NEAR(area_of(mesh, [&](const Vertex& v) { return v.surface.object < 6; }), 6, 0.01);
}

TEST(LightReach, WhatACameraSeesIsCoveredThoughItIsDark) {
  const Scene scene =
      scene_of(kMaterial + std::string("objects:\n") + hollow_cube(0, 1) + kLamp +
               "cameras: {outside: {eye: [-3, -3, 4], look_at: [0.5, 0.5, 0.5], fov: 40}}\n");
  const Triangulation mesh = covered(scene, 0.1);
  EXPECT_NEAR(area_of(mesh, [](const Vertex& v) { return v.surface.object < 6; }), 6 + 3, 0.02);
}

TEST(LightReach, WhatShinesItselfIsCoveredInside) {
  const Scene scene = scene_of(kMaterial + std::string("objects:\n") + hollow_cube(0, 1) + kLamp +
                               hollow_cube(0.5, 0.7, ", emission: {exitance: 1}"));
  const Triangulation mesh = covered(scene, 0.1);
  EXPECT_NEAR(area_of(mesh, [](const Vertex& v) { return v.surface.object > 6; }), 12 * 0.04, 0.01);
}

TEST(LightReach, ARoomIsReachedThroughASlitInItsLampsHousing) {
  // The lamp stands in a box whose lid leaves a gap of 2 cm on one side of four.
  std::string housing;
  const std::string faces = hollow_cube(0.1, 0.5);
  housing = faces.substr(0, faces.rfind("  - "));
  housing +=
      "  - {shape: {parallelogram: {corner: [0.1, 0.1, 0.5], u: [0.38, 0, 0], v: [0, 0.4, 0]}}, "
      "material: m}\n"
      "  - {shape: {sphere: {center: [0.3, 0.3, 0.2], radius: 0.05}}, material: m, emission: "
      "{exitance: 100}}\n";
  const Scene scene = scene_of(
      kMaterial +
      std::string(
          "objects:\n  - {shape: {box: {lower: [0, 0, 0], upper: [2, 2, 2], inward: true}}, "
          "material: m}\n") +
      housing);
  const Triangulation mesh = covered(scene, 0.2);
  EXPECT_NEAR(area_of(mesh, [](const Vertex& v) { return v.surface.object == 0; }), 24, 0.05);
}

TEST(LightReach, TheSkyShinesThroughAWindowButNotIntoAClosedBoxBesideIt) {
  const std::string faces = hollow_cube(0, 1);
  const std::string window =
      "  - {material: m, shape: {polygon: {points: [[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], "
      "holes: [[[0.4, 0.4, 1], [0.4, 0.6, 1], [0.6, 0.6, 1], [0.6, 0.4, 1]]]}}}\n";
  const Scene scene = scene_of(
      "sky: {type: overcast, illuminance: 10000}\n" + std::string(kMaterial) + "objects:\n" +
      faces.substr(0, faces.rfind("  - ")) + window + hollow_cube(1.4, 1.6));
  const Triangulation mesh = covered(scene, 0.1);
  const auto outwards = [](const Vertex& v) {
    const double middle = v.surface.object < 6 ? 0.5 : 1.5;
    return dot(v.normal, v.position - Vec3{middle, middle, middle}) > 0;
  };
  const auto area = [&](bool room, bool outer) {
    return area_of(mesh, [&](const Vertex& v) {
      return (v.surface.object < 6) == room && outwards(v) == outer;
    });
  };
  EXPECT_NEAR(area(true, false), 6 - 0.04, 0.02);
  EXPECT_NEAR(area(true, true), 6 - 0.04, 0.02);
  EXPECT_NEAR(area(false, true), 6 * 0.04, 0.01);
  EXPECT_EQ(area(false, false), 0);
}

TEST(LightReach, EveryPatchBetweenPartitionsIsCovered) {
  // Slats stand on a floor, closer together than points are apart.
  constexpr int kSlats = 30;
  std::string objects =
      "objects:\n  - {shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}}, "
      "material: m, sides: front}\n";
  for (int i = 0; i < kSlats; ++i) {
    objects += fmt::format(
        "  - {{shape: {{parallelogram: {{corner: [{}, -0.1, 0], u: [0, 1.2, 0], v: [0, 0, "
        "0.05]}}}}, material: m}}\n",
        (i + 0.5) / kSlats);
  }
  const Scene scene = scene_of(kMaterial + objects +
                               "lights:\n  - {point: {position: [0.5, 0.5, 2], intensity: 100}}\n");
  const Triangulation mesh = covered(scene, 0.25);
  EXPECT_NEAR(area_of(mesh, [](const Vertex& v) { return v.surface.object == 0; }), 1, 0.005);
}

}  // namespace
}  // namespace isolux
