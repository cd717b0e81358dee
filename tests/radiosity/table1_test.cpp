#include <gtest/gtest.h>

#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

double mean_triangles(double max_edge, double contrast) {
  double sum = 0;
  for (std::uint64_t seed : {1, 2}) {
    Options options;
    options.method = Method::shooting;
    options.rules.max_edge = max_edge;
    options.contrast = contrast;
    options.iterations = 25;
    options.seed = seed;
    sum += static_cast<double>(solve(paper_room(), options).statistics.triangles);
  }
  return sum / 2;
}

// The cheapest corner of Table 1; examples/lalonde1993/reproduce prints all nine cells.
TEST(Table1, TheCellsOfDelta03) {
  EXPECT_NEAR(std::log(mean_triangles(0.3, 5.0) / 2787), 0, 0.1);
  EXPECT_NEAR(std::log(mean_triangles(0.3, 1.5) / 7851), 0, 0.1);
}

}  // namespace
}  // namespace isolux
