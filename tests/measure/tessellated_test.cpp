#include "support/tessellated.h"

#include <gtest/gtest.h>

#include "isolux/core/version.h"
#include "isolux/measure/measure.h"
#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

/// Points in the middle of n × n cells of the floor, the walls and the ceiling of the unit cube.
std::vector<MeasurePoint> points_on_walls(int n) {
  std::vector<MeasurePoint> points;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {0.0, 1.0}) {
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
          MeasurePoint point;
          point.position[axis] = side;
          point.position[(axis + 1) % 3] = (i + 0.5) / n;
          point.position[(axis + 2) % 3] = (j + 0.5) / n;
          point.normal[axis] = 1 - 2 * side;
          points.push_back(point);
        }
      }
    }
  }
  return points;
}

std::vector<double> illuminances(const Scene& scene, std::span<const MeasurePoint> points) {
  Options options;
  options.tolerance = 0.01;
  Solved solved = solve(scene, options);
  EXPECT_TRUE(solved.statistics.converged);
  const Solution solution{scene, std::move(solved.mesh), options, solved.statistics, kVersion};
  std::vector<double> values;
  for (const Measurement& m : measure(solution, points)) values.push_back(m.illuminance());
  return values;
}

// The points stand for equal areas, so that plain means are means over the area.
TEST(Tessellated, ThePapersRoomIsLitAsItIsAsDrawn) {
  const Scene drawn = paper_room(), cut = tessellated(drawn, 64);
  for (const std::uint32_t i : {1u, 2u}) {
    EXPECT_TRUE(cut.objects[i].shape->solid());
    EXPECT_NEAR(*cut.objects[i].shape->area() / *drawn.objects[i].shape->area(), 1, 3e-3);
  }
  const std::vector<MeasurePoint> points = points_on_walls(12);
  const std::vector<double> a = illuminances(drawn, points), b = illuminances(cut, points);
  double mean = 0, difference = 0, squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    mean += a[i] / double(points.size());
    difference += (b[i] - a[i]) / double(points.size());
    squares += (b[i] - a[i]) * (b[i] - a[i]) / double(points.size());
  }
  EXPECT_GT(mean, 100);
  EXPECT_LT(std::abs(difference), 0.003 * mean);
  EXPECT_LT(std::sqrt(squares), 0.01 * mean);
}

}  // namespace
}  // namespace isolux
