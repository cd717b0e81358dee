#include "isolux/measure/measure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "isolux/core/error.h"
#include "isolux/core/parallel.h"
#include "solution/small_solution.h"

namespace isolux {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// The form factor from a point to a rectangle a × b parallel to it at distance h, the point below
/// one of its corners (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-4).
double corner_form_factor(double a, double b, double h) {
  const double p = std::hypot(a, h), q = std::hypot(b, h);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2 * std::numbers::pi);
}

/// small_solution() without reflected light: only the lamp shines.
Solution lamp_alone() {
  Solution solution = small_solution();
  for (Vertex& v : solution.mesh.vertices()) v.irradiance = {};
  return solution;
}

TEST(Measure, LampAloneGivesTheClosedForm) {
  const Solution solution = lamp_alone();
  // Above the ball, centred under the lamp: four quarters of its 0.125 m square.
  const std::vector<MeasurePoint> points = {
      {{0.5, 0.5, 0.75}, {0, 0, 1}}, {{0.5, 0.5, 0.75}, {0, 0, -1}}, {{0.5, 0.5, 0.1}, {0, 0, 1}}};
  const auto measured = measure(solution, points);
  const double expected = kSmallExitance * 4 * corner_form_factor(0.0625, 0.0625, 0.25);
  EXPECT_NEAR(measured[0].illuminance(), expected, 1e-6 * expected);
  EXPECT_NEAR(measured[0].irradiance.b, expected, 1e-6 * expected);
  EXPECT_EQ(measured[1].illuminance(), 0) << "facing away";
  EXPECT_EQ(measured[2].illuminance(), 0) << "in the shadow of the ball";
}

TEST(Measure, PointsAFewDigitsInsideASurfaceAreStillLit) {
  const Solution solution = lamp_alone();
  const auto measured = measure(solution, std::vector<MeasurePoint>{
                                              {{0.5, 0.5, 0.7}, {0, 0, 1}},
                                              {{0.5, 0.5, 0.69999}, {0, 0, 1}},
                                          });
  EXPECT_GT(measured[0].illuminance(), 10);
  EXPECT_NEAR(measured[1].illuminance(), measured[0].illuminance(), 0.2);
}

TEST(Measure, OddPointsGiveFiniteNumbers) {
  const Solution solution = small_solution();
  const std::vector<MeasurePoint> points = {{{0.4375, 0.4375, 1}, {0, 0, 1}},  // the lamp's corner
                                            {{0.4375, 0.4375, 1}, {1, 0, 0}},
                                            {{0, 0, 0}, {0, 0, -1}},
                                            {{0.5, 0.5, 0.5}, {0, 0, 1}},  // inside the ball
                                            {{1000, -1000, 0}, {0, 0, 1}}};
  for (const Measurement& m : measure(solution, points)) EXPECT_TRUE(is_finite(m.irradiance));
  EXPECT_TRUE(measure(solution, {}).empty());
}

TEST(Measure, PointsThatAreNotInMetresAreRefused) {
  const std::vector<MeasurePoint> points = {{{0.5, 0.5, 0.1}, {0, 0, 1}},
                                            {{50'000, 0, 0}, {0, 0, 1}}};
  EXPECT_THAT([&] { measure(small_solution(), points); },
              ThrowsMessage<InputError>(HasSubstr("point 2 lies 5e+04 m from the scene")));
  const std::vector<MeasurePoint> far = {{{1e300, 1e300, 0}, {0, 0, 1}}};
  EXPECT_THROW(measure(small_solution(), far), InputError);
}

TEST(Measure, IsTheSameOnAnyNumberOfThreads) {
  const Solution solution = small_solution();
  std::vector<MeasurePoint> points;
  for (int i = 0; i < 300; ++i) points.push_back({{0.003 * i, 0.1, 0.2}, {0, 0, 1}});
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return measure(solution, points);
  };
  const auto one = run(1), four = run(4);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(one[i].irradiance, four[i].irradiance);
}

}  // namespace
}  // namespace isolux
