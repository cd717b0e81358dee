#include "isolux/radiosity/source_light.h"

#include <gmock/gmock.h>

#include <numbers>

#include "isolux/core/error.h"
#include "isolux/discretization/interpolation.h"
#include "isolux/discretization/mesh_lookup.h"
#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

constexpr double kPi = std::numbers::pi;

constexpr const char* kFloor =
    "materials: {grey: {reflectance: 0.5}, black: {reflectance: 0}}\n"
    "objects:\n"
    "  - {name: floor, material: black, sides: front,\n"
    "     shape: {parallelogram: {corner: [-2, -2, 0], u: [4, 0, 0], v: [0, 4, 0]}}}\n";

constexpr const char* kBulb = "lights: [{point: {position: [0.2, 0.1, 2], intensity: 100}}]\n";

double illuminance(const RayCaster& rays, const Vec3& point, const Vec3& normal) {
  const Receiver receiver{point, normal};
  Rgb irradiance;
  for (const Source& source : rays.scene().sources) {
    add_source_light(rays, source, {&receiver, 1}, {&irradiance, 1});
  }
  return luminance(irradiance);
}

TEST(SourceLight, OfAPointFallsWithTheSquareOfTheDistanceAndTheCosine) {
  const Scene scene = scene_of(std::string(kFloor) + kBulb);
  const RayCaster rays(scene);
  for (const double x : {-1.5, 0.0, 0.2, 1.9}) {
    const Vec3 d = Vec3{0.2, 0.1, 2} - Vec3{x, 0.3, 0};
    EXPECT_NEAR(illuminance(rays, {x, 0.3, 0}, {0, 0, 1}), 100 * 2 / std::pow(length(d), 3), 1e-9);
  }
  EXPECT_EQ(illuminance(rays, {0, 0, 0}, {0, 0, -1}), 0) << "it faces away";
}

TEST(SourceLight, OfTheSunFallsWithTheCosineAlone) {
  const Scene scene = scene_of(std::string(kFloor) +
                               "lights: [{directional: {direction: [3, 0, -4], illuminance: 10}}]");
  const RayCaster rays(scene);
  EXPECT_NEAR(illuminance(rays, {1, 1, 0}, {0, 0, 1}), 8, 1e-9);
  EXPECT_NEAR(illuminance(rays, {1, 1, 0.5}, {-1, 0, 0}), 6, 1e-9);
  EXPECT_EQ(illuminance(rays, {1, 1, -0.5}, {0, 0, 1}), 0) << "below the floor";
}

TEST(SourceLight, WhatArrivesIsAllInAClosedRoomAndItsPartInTheOpen) {
  const Scene room = scene_of(
      "materials: {grey: {reflectance: 0.5}}\n"
      "objects: [{material: grey, shape: {box: {lower: [-1, -1, 0], upper: [1, 1, 3], inward: "
      "true}}}]\n" +
      std::string(kBulb));
  EXPECT_NEAR(arriving_flux(RayCaster(room), room.sources[0]), 400 * kPi, 1e-6);

  const Scene open = scene_of(std::string(kFloor) +
                              "lights: [{point: {position: [0, 0, 2], intensity: 100}}, "
                              "{directional: {direction: [3, 0, -4], illuminance: 10}}]");
  const RayCaster rays(open);
  // The floor's half side is the light's height: one of six sides of a cube.
  EXPECT_NEAR(arriving_flux(rays, open.sources[0]), 400 * kPi / 6, 400 * kPi * 0.001);
  EXPECT_NEAR(arriving_flux(rays, open.sources[1]), 8 * 16, 0.5);
}

/// Radius, about the origin and towards `angle`, at which the light interpolated in the floor's
/// mesh is half of `lit`.
double half_lit_radius(const Triangulation& mesh, const MeshLookup& lookup, double angle,
                       double from, double to, double lit) {
  constexpr int kSteps = 400;
  for (int i = 0; i <= kSteps; ++i) {
    const double r = from + (to - from) * i / kSteps;
    const auto place = lookup.place({r * std::cos(angle), r * std::sin(angle), 0}, {0, 0, 1});
    if (place && luminance(interpolate_irradiance(mesh, *place)) > lit / 2) return r;
  }
  return to;
}

struct ShadowCase {
  const char* name;
  const char* object;
  const char* light;
  double radius;  // of the round shadow on the floor
  double lit;     // illuminance at its edge, were there no shadow
};

class HardShadow : public testing::TestWithParam<ShadowCase> {};

// The mesh follows the edge: on every side half the light is reached where the shadow ends, to
// within a fortieth of its radius, and it is 1 % right a tenth of the radius away.
TEST_P(HardShadow, HasItsEdgeInTheMesh) {
  const ShadowCase& c = GetParam();
  const Scene scene = scene_of(std::string(kFloor) + c.object + c.light);
  Options options;
  options.tolerance = 0.01;
  const Solved solved = solve(scene, options);
  EXPECT_TRUE(solved.statistics.converged);
  EXPECT_THAT(solved.mesh.validate(), testing::IsEmpty());
  const MeshLookup lookup(solved.mesh);
  const RayCaster rays(scene);
  for (int k = 0; k < 32; ++k) {
    const double angle = 2 * kPi * (k + 0.3) / 32;
    EXPECT_NEAR(half_lit_radius(solved.mesh, lookup, angle, 0.5 * c.radius, 1.5 * c.radius, c.lit),
                c.radius, c.radius / 40)
        << "at " << angle;
    for (const double r : {0.9 * c.radius, 1.1 * c.radius}) {
      const Vec3 point{r * std::cos(angle), r * std::sin(angle), 0};
      const double exact = illuminance(rays, point, {0, 0, 1});
      const auto place = lookup.place(point, {0, 0, 1});
      ASSERT_TRUE(place);
      EXPECT_NEAR(luminance(interpolate_irradiance(solved.mesh, *place)), exact, 0.01 * c.lit);
      EXPECT_EQ(exact > 0, r > c.radius);
    }
  }
}

// A sphere of radius 0.3 at height 1 under a point at height 2 hides sin a = 0.3.
INSTANTIATE_TEST_SUITE_P(
    Source, HardShadow,
    testing::Values(
        ShadowCase{"PointOverSphere",
                   "  - {material: black, shape: {sphere: {center: [0, 0, 1], radius: 0.3}}}\n",
                   "lights: [{point: {position: [0, 0, 2], intensity: 100}}]\n", 0.628970902033151,
                   100 * 2 / 9.2155},
        ShadowCase{"SunOverSphere",
                   "  - {material: black, shape: {sphere: {center: [0, 0, 1], radius: 0.5}}}\n",
                   "lights: [{directional: {direction: -z, illuminance: 25}}]\n", 0.5, 25},
        ShadowCase{"PointOverDisk",
                   "  - {material: black, shape: {disk: {center: [0, 0, 1], normal: z, radius: "
                   "0.3}}}\n",
                   "lights: [{point: {position: [0, 0, 2], intensity: 100}}]\n", 0.6,
                   100 * 2 / 9.1034},
        ShadowCase{"SunOverCsg",
                   "  - material: black\n"
                   "    shape: {intersection: [{sphere: {center: [0, 0, 1], radius: 0.5}}, "
                   "{box: {lower: [-1, -1, 1], upper: [1, 1, 2]}}]}\n",
                   "lights: [{directional: {direction: -z, illuminance: 25}}]\n", 0.5, 25}),
    [](const auto& shadow) { return shadow.param.name; });

// A convex body gets from a uniform sky what its area would get flat in the open: π L A.
TEST(SourceLight, WhatArrivesOfASky) {
  const Scene floor =
      scene_of(std::string(kFloor) + "sky: {type: uniform, zenith: 100, ground: 50}\n");
  EXPECT_NEAR(arriving_flux(RayCaster(floor), *floor.sky), kPi * 100 * 16, 0.003 * kPi * 1600);
  const char* const kSphere =
      "materials: {black: {reflectance: 0}}\n"
      "objects: [{material: black, shape: {sphere: {center: [3, 2, 1], radius: 0.7}}}]\n";
  const double area = 4 * kPi * 0.49;
  const Scene sphere =
      scene_of(std::string(kSphere) + "sky: {type: uniform, zenith: 100, ground: 100}\n");
  EXPECT_NEAR(arriving_flux(RayCaster(sphere), *sphere.sky), kPi * 100 * area,
              0.003 * kPi * 100 * area);
  const Scene dark_ground = scene_of(std::string(kSphere) + "sky: {type: uniform, zenith: 100}\n");
  EXPECT_NEAR(arriving_flux(RayCaster(dark_ground), *dark_ground.sky), kPi * 50 * area,
              0.003 * kPi * 50 * area);
  for (int type = 1; type <= kSkyTypes; ++type) {
    Sky sky{standard_sky(type), {0, 0, 1}, normalized(Vec3{0.3, 0.4, 0.8}), gray(100), {}};
    const double expected = luminance(horizontal_illuminance(sky)) * 16;
    EXPECT_NEAR(arriving_flux(RayCaster(floor), sky), expected, 0.005 * expected) << type;
  }
}

// Two roads to the mean: all that the bulb emits is absorbed in the end.
TEST(SourceLight, InAClosedRoomAllIsAbsorbed) {
  const Scene scene = scene_of(
      "materials: {grey: {reflectance: 0.7}}\n"
      "objects: [{material: grey, shape: {box: {lower: [-1, -1, 0], upper: [1, 1, 3], inward: "
      "true}}}]\n" +
      std::string(kBulb));
  Options options;
  options.tolerance = 0.01;
  const Solved solved = solve(scene, options);
  EXPECT_TRUE(solved.statistics.converged);
  const double area = 2 * 4 + 4 * 6;
  EXPECT_NEAR(solved.statistics.mean_irradiance, 400 * kPi / (0.3 * area), 0.005 * 400 * kPi / 9.6);
}

TEST(SourceLight, ThePapersMethodRefusesIt) {
  const Scene scene = scene_of(std::string(kFloor) + kBulb);
  Options options;
  options.method = Method::shooting;
  EXPECT_THROW(solve(scene, options), InputError);
}

}  // namespace
}  // namespace isolux
