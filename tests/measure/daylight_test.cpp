// Daylight where its true value is known: the cases of CIE 171:2006 for openings without glass,
// under the skies of CIE S 011, and closed forms.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "isolux/measure/measure.h"
#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

using nlohmann::json;
using std::numbers::pi;

json read_case(const std::string& file) {
  std::ifstream in(shared_dir() / "validation/cases" / file);
  return json::parse(in);
}

Vec3 vec3(const json& j) { return {j[0], j[1], j[2]}; }

/// A sky that gives an open horizontal surface 100 lx, so that measured values are per cent; the
/// ground is as bright as one of reflectance `ground` under it.
Sky sky_of_100_lux(int type, const Vec3& sun, double ground = 0) {
  Sky sky;
  sky.distribution = standard_sky(type);
  sky.sun = normalized(sun);
  sky.zenith = gray(100 / horizontal_illuminance(sky.distribution, sky.sun.z));
  sky.ground = gray(100 * ground / pi);
  return sky;
}

Solution solved(Scene scene, const Sky& sky, double tolerance = 0.01) {
  scene.sky = sky;
  Solution solution{std::move(scene), Triangulation({}, Bounds{{0, 0, 0}, {1, 1, 1}}), {}, {}, ""};
  solution.options.tolerance = tolerance;
  Solved result = solve(solution.scene, solution.options);
  solution.mesh = std::move(result.mesh);
  solution.statistics = result.statistics;
  EXPECT_TRUE(solution.statistics.converged);
  return solution;
}

Measurement at(const Solution& solution, const Vec3& position, const Vec3& normal) {
  const MeasurePoint point{position, normal};
  return measure(solution, {&point, 1}).front();
}

/// The room of the cases, 4 × 4 × 3 m and black, of walls without thickness.
std::string room(const std::vector<std::string>& walls) {
  std::string text = "materials: {black: {reflectance: 0}}\nobjects:\n";
  const auto add = [&](const std::string& wall) {
    text += "  - {material: black, sides: front, shape: {parallelogram: " + wall + "}}\n";
  };
  add("{corner: [0, 0, 0], u: [4, 0, 0], v: [0, 4, 0]}");
  add("{corner: [0, 0, 0], u: [0, 4, 0], v: [0, 0, 3]}");
  add("{corner: [4, 0, 0], u: [0, 0, 3], v: [0, 4, 0]}");
  add("{corner: [0, 4, 0], u: [4, 0, 0], v: [0, 0, 3]}");
  for (const std::string& wall : walls) add(wall);
  return text;
}

/// The values at the points of a case are right within 1 %, and what it gives of their digits; or
/// within their error, if that is not much more.
void expect_points(const Solution& solution, const json& points, const json& values,
                   const std::string& what) {
  for (const json& point : points) {
    const std::string id = point.at("id");
    if (!values.contains(id)) continue;
    const Measurement found = at(solution, vec3(point.at("pos")), vec3(point.at("normal")));
    const double expected = values.at(id);
    const double allowed =
        std::min(std::max(0.01 * expected, found.error.value()), 0.04 * expected);
    EXPECT_NEAR(found.illuminance(), expected, allowed + 0.005) << what << ", " << id;
  }
}

TEST(Daylight, Cie171RoofOpening) {
  ISOLUX_NEED_SHARED();
  const json data = read_case("cie171_5_9_roof_sky.json");
  const std::string front = "{corner: [0, 0, 0], u: [0, 0, 3], v: [4, 0, 0]}";
  const std::string whole = room({front});
  const std::string small = room({front, "{corner: [0, 0, 3], u: [0, 4, 0], v: [1.5, 0, 0]}",
                                  "{corner: [2.5, 0, 3], u: [0, 4, 0], v: [1.5, 0, 0]}",
                                  "{corner: [1.5, 0, 3], u: [0, 1.5, 0], v: [1, 0, 0]}",
                                  "{corner: [1.5, 2.5, 3], u: [0, 1.5, 0], v: [1, 0, 0]}"});
  const Vec3 sun = vec3(data.at("geometry").at("sun_dir"));
  for (const std::string opening : {"1x1", "4x4"}) {
    for (const int type : {1, 5, 12, 15, 16}) {
      const Solution solution =
          solved(scene_of(opening == "1x1" ? small : whole), sky_of_100_lux(type, sun), 0.05);
      expect_points(solution, data.at("points"),
                    data.at("expected").at("values").at(opening).at(std::to_string(type)),
                    fmt::format("{}, sky {}", opening, type));
    }
  }
}

TEST(Daylight, Cie171Facade) {
  ISOLUX_NEED_SHARED();
  const json data = read_case("cie171_5_11_facade_sky.json");
  const std::string ceiling = "{corner: [0, 0, 3], u: [0, 4, 0], v: [4, 0, 0]}";
  const std::string whole = room({ceiling});
  const std::string small = room({ceiling, "{corner: [0, 0, 0], u: [0, 0, 1], v: [4, 0, 0]}",
                                  "{corner: [0, 0, 2], u: [0, 0, 1], v: [4, 0, 0]}",
                                  "{corner: [0, 0, 1], u: [0, 0, 1], v: [1, 0, 0]}",
                                  "{corner: [3, 0, 1], u: [0, 0, 1], v: [1, 0, 0]}"});
  const Vec3 sun = vec3(data.at("geometry").at("sun_dir"));
  for (const auto& [opening, skies] : data.at("expected").at("values").items()) {
    for (const auto& [type, values] : skies.items()) {
      const Solution solution = solved(scene_of(opening == "2x1" ? small : whole),
                                       sky_of_100_lux(std::stoi(type), sun, 0.3), 0.02);
      expect_points(solution, data.at("points"), values, fmt::format("{}, sky {}", opening, type));
    }
  }
}

constexpr const char* kFloor =
    "materials: {grey: {reflectance: 0.5}}\n"
    "objects:\n"
    "  - {material: grey, sides: front,\n"
    "     shape: {parallelogram: {corner: [-2, -2, 0], u: [4, 0, 0], v: [0, 4, 0]}}}\n";

TEST(Daylight, AnOpenFloorHasWhatTheSkyGives) {
  for (int type = 1; type <= kSkyTypes; ++type) {
    const Sky sky = sky_of_100_lux(type, {0.3, 0.4, 0.8}, 0.3);
    const Solution solution = solved(scene_of(kFloor), sky);
    EXPECT_NEAR(at(solution, {0.3, 0.2, 0}, {0, 0, 1}).illuminance(), 100, 0.3) << type;
    EXPECT_NEAR(solution.statistics.mean_irradiance, 100, 0.3) << type;
    const Statistics& s = solution.statistics;
    EXPECT_NEAR(s.emitted_flux, 1600, 8) << type;
    EXPECT_NEAR(s.absorbed_flux, 800, 4) << type;
    EXPECT_NEAR(s.escaped_flux, 800, 4) << type;
  }
}

TEST(Daylight, HalvesOfAUniformSkyAndTheGround) {
  const Solution solution = solved(scene_of(kFloor), sky_of_100_lux(5, {0, 0, 1}, 0.3));
  EXPECT_NEAR(at(solution, {0, 0, 9}, {0.6, 0, 0.8}).illuminance(), 90 + 0.1 * 30, 0.1);
  EXPECT_NEAR(at(solution, {9, 0, 0}, {1, 0, 0}).illuminance(), 50 + 15, 0.1);
}

TEST(Daylight, ContactShadowOfASphere) {
  ISOLUX_NEED_SHARED();
  const json values =
      read_case("contact_shadow_sphere_uniform_sky.json").at("expected").at("values");
  const Solution solution = solved(scene_of(R"(materials: {black: {reflectance: 0}}
objects:
  - {shape: {sphere: {center: [0, 0, 0.5], radius: 0.5}}, material: black}
  - {shape: {disk: {center: [0, 0, 0], normal: z, radius: 40}}, material: black, sides: front}
)"),
                                   sky_of_100_lux(5, {0, 0, 1}));
  for (const auto& [x, expected] : values.items()) {
    const double e = 100 * expected.get<double>();
    EXPECT_NEAR(at(solution, {std::stod(x), 0, 0}, {0, 0, 1}).illuminance(), e, 0.01 * e + 0.3)
        << "x = " << x;
  }
}

/// Whatever stands in a uniform sky and shines as much as it absorbs of it is as bright as the sky.
TEST(Daylight, WhatIsAsBrightAsTheSkyVanishesInIt) {
  Scene scene = scene_of(R"(materials: {grey: {reflectance: 0.5}, light: {reflectance: 0.8}}
objects:
  - {shape: {sphere: {center: [0, 0, 0.5], radius: 0.5}}, material: grey, emission: {exitance: 50}}
  - {shape: {box: {lower: [-2, -2, -0.2], upper: [2, 2, 0]}}, material: light,
     emission: {exitance: 20}}
)");
  Sky sky = sky_of_100_lux(5, {0, 0, 1});
  sky.ground = sky.zenith;
  const Solution solution = solved(scene, sky);
  double squares = 0;
  for (const Vertex& v : solution.mesh.vertices()) {
    const double off = luminance(v.irradiance) - 100;
    EXPECT_LT(std::abs(off), 3) << v.position.x << ' ' << v.position.z;
    squares += off * off;
  }
  EXPECT_LT(std::sqrt(squares / double(solution.mesh.vertices().size())), 1);
  EXPECT_NEAR(solution.statistics.mean_irradiance, 100, 0.1);
}

}  // namespace
}  // namespace isolux
