// Whole solves at their default method, measured where the true value is known.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "isolux/measure/csv.h"
#include "isolux/measure/measure.h"
#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

using nlohmann::json;

json read_case(const std::string& file) {
  std::ifstream in(shared_dir() / "validation/cases" / file);
  return json::parse(in);
}

Vec3 vec3(const json& j) { return {j[0], j[1], j[2]}; }

Solution solved(Scene scene, double tolerance, std::uint64_t seed = 1) {
  Solution solution{std::move(scene), Triangulation({}, Bounds{{0, 0, 0}, {1, 1, 1}}), {}, {}, ""};
  solution.options.tolerance = tolerance;
  solution.options.seed = seed;
  Solved result = solve(solution.scene, solution.options);
  solution.mesh = std::move(result.mesh);
  solution.statistics = result.statistics;
  EXPECT_TRUE(solution.statistics.converged);
  return solution;
}

double lux_at(const Solution& solution, const Vec3& position, const Vec3& normal) {
  const MeasurePoint point{position, normal};
  return measure(solution, {&point, 1}).front().illuminance();
}

/// The illuminance at each point of a case that names its points, to within relative + absolute,
/// lx.
void expect_points(const Solution& solution, const json& data, double relative, double absolute) {
  for (const json& point : data.at("points")) {
    const double expected = data.at("expected").at("values").at(std::string(point.at("id")));
    EXPECT_NEAR(lux_at(solution, vec3(point.at("pos")), vec3(point.at("normal"))), expected,
                relative * expected + absolute)
        << point;
  }
}

constexpr const char* kRoomMaterials = R"(materials:
  wall: {{reflectance: {}}}
  black: {{reflectance: 0}}
objects:
)";

TEST(Validation, Cie171AreaSource) {
  ISOLUX_NEED_SHARED();
  const json data = read_case("cie171_5_3_area_source.json");
  const Solution solution = solved(scene_of(fmt::format(kRoomMaterials, 0) + R"(
  - {shape: {box: {lower: [0, 0, 0], upper: [4, 4, 3], inward: true}}, material: wall}
  - shape: {parallelogram: {corner: [1.5, 1.5, 3], u: [0, 1, 0], v: [1, 0, 0]}}
    material: black
    sides: front
    emission: {exitance: 3141.592653589793}
)"),
                                   0.01);
  expect_points(solution, data, 0.002, 0);
}

/// S2 of the case as an emitter, in front of black walls, with what stands between.
Scene reflecting_surface(const std::string& emitter, const std::string& obstruction) {
  return scene_of(fmt::format(kRoomMaterials, 0) + "  - {shape: {parallelogram: " + emitter +
                  "}, material: black, sides: front, emission: {exitance: 100}}\n" + obstruction);
}

TEST(Validation, Cie171DiffuseReflection) {
  ISOLUX_NEED_SHARED();
  const json data = read_case("cie171_5_6_diffuse_reflection.json");
  const Solution solution = solved(
      reflecting_surface("{corner: [0, 0, 0], u: [4, 0, 0], v: [0, 4, 0]}",
                         "  - {shape: {parallelogram: {corner: [0, 0, 3], u: [0, 4, 0], v: [4, 0, "
                         "0]}}, material: black, sides: front}\n"),
      0.01);
  expect_points(solution, data, 0.005, 0);
}

TEST(Validation, Cie171Obstruction) {
  ISOLUX_NEED_SHARED();
  const json data = read_case("cie171_5_7_obstruction_CORRECTED.json");
  const Solution solution = solved(
      reflecting_surface("{corner: [0, 4, 0], u: [4, 0, 0], v: [0, 0, 3]}",
                         "  - {shape: {box: {lower: [0, 2.5, 0], upper: [4, 2.7, 1]}}, material: "
                         "black}\n"),
      0.01);
  expect_points(solution, data, 0.005, 0.01);
}

/// A cube of 4 m whose only light is a point in the middle: a ball of 1 cm stands for it.
Scene cube(double reflectance) {
  return scene_of(fmt::format(kRoomMaterials, reflectance) + R"(
  - {shape: {box: {lower: [0, 0, 0], upper: [4, 4, 4], inward: true}}, material: wall}
  - {shape: {sphere: {center: [2, 2, 2], radius: 0.01}}, material: black, emission: {flux: 10000}}
)");
}

TEST(Validation, Cie171InterreflectionOfACube) {
  ISOLUX_NEED_SHARED();
  const json values = read_case("cie171_5_8_internal_reflected.json").at("expected").at("values");
  for (const auto& [reflectance, indirect] : values.items()) {
    const Statistics s = solved(cube(std::stod(reflectance)), 0.01).statistics;
    const double direct = 10000.0 / 96;
    const double expected = direct + indirect.get<double>();
    EXPECT_NEAR(s.mean_irradiance, expected, 0.003 * expected) << "ρ = " << reflectance;
  }
}

TEST(Validation, CubePointByPoint) {
  ISOLUX_NEED_SHARED();
  const json data = read_case("cube_pointwise.json");
  for (const double reflectance : {0.2, 0.5, 0.8}) {
    const Solution solution = solved(cube(reflectance), 0.003);
    const json values =
        data.at("expected").at("values").at(fmt::format("R1cube_rho{}", reflectance));
    for (const json& point : data.at("points")) {
      const double expected = values.at(std::string(point.at("id"))).at("value");
      EXPECT_NEAR(lux_at(solution, vec3(point.at("pos")), {0, 0, 1}), expected, 0.005 * expected)
          << "ρ = " << reflectance << ' ' << point;
    }
  }
}

TEST(Validation, EnergyBetweenTwoSquares) {
  ISOLUX_NEED_SHARED();
  const json expected = read_case("square_transfer_zatz.json").at("expected");
  const std::string receiver =
      "  - {shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}}, material: "
      "black, sides: front}\n";
  const auto check = [&](const std::string& emitter, const json& points) {
    const Solution solution = solved(reflecting_surface(emitter, receiver), 0.01);
    for (const json& point : points) {
      const double e = 100 * point.at("E").get<double>();
      EXPECT_NEAR(lux_at(solution, {point.at("st")[0], point.at("st")[1], 0}, {0, 0, 1}), e,
                  0.001 * e)
          << emitter << ' ' << point;
    }
  };
  for (const auto& [distance, pair] : expected.at("parallel").items()) {
    check("{corner: [0, 0, " + distance.substr(9) + "], u: [0, 1, 0], v: [1, 0, 0]}",
          pair.at("points"));
  }
  check("{corner: [0, 0, 0], u: [0, 0, 1], v: [1, 0, 0]}",
        expected.at("perpendicular").at("points"));
}

TEST(Validation, ContactShadowOfASphereUnderTheSky) {
  ISOLUX_NEED_SHARED();
  const json values =
      read_case("contact_shadow_sphere_uniform_sky.json").at("expected").at("values");
  const Solution solution = solved(scene_of(R"(materials: {black: {reflectance: 0}}
objects:
  - shape:
      difference:
        - box: {lower: [-41, -41, 0], upper: [41, 41, 41]}
        - sphere: {center: [0, 0, 0], radius: 40}
    material: black
    emission: {exitance: 100}
  - {shape: {sphere: {center: [0, 0, 0.5], radius: 0.5}}, material: black}
  - {shape: {disk: {center: [0, 0, 0], normal: z, radius: 40}}, material: black, sides: front}
)"),
                                   0.01);
  for (const auto& [x, expected] : values.items()) {
    const double e = 100 * expected.get<double>();
    EXPECT_NEAR(lux_at(solution, {std::stod(x), 0, 0}, {0, 0, 1}), e, 0.01 * e + 0.3)
        << "x = " << x;
  }
}

TEST(Validation, SphericalLight) {
  ISOLUX_NEED_SHARED();
  const json expected = read_case("sphere_light.json").at("expected");
  const Solution solution = solved(scene_of(R"(materials: {black: {reflectance: 0}}
objects:
  - {shape: {sphere: {center: [0, 0, 1.5], radius: 0.5}}, material: black, emission: {exitance: 100}}
  - {shape: {disk: {center: [0, 0, 0], normal: z, radius: 6}}, material: black, sides: front}
)"),
                                   0.01);
  for (const auto& [x, e] : expected.at("floor_points_x_0_0").items()) {
    EXPECT_NEAR(lux_at(solution, {std::stod(x), 0, 0}, {0, 0, 1}), 100 * e.get<double>(),
                0.5 * e.get<double>())
        << "x = " << x;
  }
  for (const auto& [z, e] : expected.at("wall_points_2_0_z_normal_minus_x").items()) {
    EXPECT_NEAR(lux_at(solution, {2, 0, std::stod(z)}, {-1, 0, 0}), 100 * e.get<double>(),
                0.5 * e.get<double>())
        << "z = " << z;
  }
}

/// A column of a CSV file that has numbers alone below its header.
std::vector<double> column(const std::filesystem::path& path, std::size_t index) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  std::vector<double> values;
  while (std::getline(in, line)) {
    std::stringstream fields(line);
    std::string field;
    for (std::size_t i = 0; i <= index; ++i) std::getline(fields, field, ',');
    values.push_back(std::stod(field));
  }
  return values;
}

TEST(Validation, SensorsOfThePapersRoomAtEveryTolerance) {
  ISOLUX_NEED_SHARED();
  const auto file = shared_dir() / "validation/reference/lalonde_room_grey_sensors.csv";
  const std::vector<MeasurePoint> points = load_points(file);
  const std::vector<double> reference = column(file, 6);  // by path tracing, 200,000 paths each
  ASSERT_EQ(points.size(), reference.size());
  const std::vector<std::pair<double, std::uint64_t>> runs = {{0.1, 1},  {0.1, 3},  {0.1, 7},
                                                              {0.05, 1}, {0.05, 3}, {0.02, 1},
                                                              {0.02, 3}, {0.01, 1}, {0.005, 1}};
  for (const auto& [tolerance, seed] : runs) {
    const Solution solution =
        solved(load_scene(source_dir() / "examples/lalonde1993/grey-room.yaml"), tolerance, seed);
    const std::vector<Measurement> measured = measure(solution, points);
    double squares = 0, wrong = 0, bars = 0, mean = 0, inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double error = std::abs(measured[i].illuminance() - reference[i]);
      squares += error * error;
      wrong += error;
      bars += *measured[i].error;
      inside += error <= *measured[i].error;
      mean += reference[i];
    }
    const auto n = static_cast<double>(points.size());
    EXPECT_LE(std::sqrt(squares / n) / (mean / n), tolerance);
    EXPECT_GE(inside / n, 0.95) << tolerance << ", seed " << seed;
    EXPECT_LE(bars, 5 * wrong) << tolerance << ", seed " << seed;
    EXPECT_LT(solution.statistics.triangles, 9056u) << "the paper's own count";
  }
}

}  // namespace
}  // namespace isolux
