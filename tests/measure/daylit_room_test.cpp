// Rooms with a window, furniture and reflected daylight, held against path tracing.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "isolux/measure/csv.h"
#include "isolux/measure/measure.h"
#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

struct Reference {
  double illuminance, standard_error;  // lx
};

/// The columns that benchmarks/reference adds to the points.
std::vector<Reference> references_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<Reference> found;
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    double skipped = 0;
    for (int i = 0; i < 6; ++i) fields >> skipped;
    Reference reference{};
    fields >> reference.illuminance >> reference.standard_error;
    found.push_back(reference);
  }
  return found;
}

class DaylitRoom : public testing::TestWithParam<const char*> {};

// The reference of tests/measure/daylight/NAME.yaml is NAME.csv, which was made from its own
// points:
//   build/benchmark/benchmarks/reference NAME.yaml NAME.csv 0.003
TEST_P(DaylitRoom, AgreesWithPathTracing) {
  const auto folder = source_dir() / "tests/measure/daylight";
  const std::string name = GetParam();
  Scene scene = load_scene(folder / (name + ".yaml"));
  Options options;
  options.tolerance = 0.02;
  Solved solved = solve(scene, options);
  EXPECT_TRUE(solved.statistics.converged);
  const Solution solution{std::move(scene), std::move(solved.mesh), options, solved.statistics, ""};

  const auto points = load_points(folder / (name + ".csv"));
  const auto references = references_of(folder / (name + ".csv"));
  const auto measured = measure(solution, points);
  ASSERT_EQ(references.size(), measured.size());
  double within = 0;
  const auto n = static_cast<double>(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const auto& [expected, standard_error] = references[i];
    const double off = measured[i].illuminance() - expected;
    const Vec3& p = points[i].position;
    ASSERT_TRUE(measured[i].error);
    within += std::abs(off) <= *measured[i].error + 2 * standard_error;
    EXPECT_LT(std::abs(off), 0.05 * expected) << "at " << p.x << ' ' << p.y << ' ' << p.z;
  }
  // The errors are those that 95 in 100 values keep to.
  EXPECT_GE(within, 0.9 * n);
}

INSTANTIATE_TEST_SUITE_P(Daylight, DaylitRoom, testing::Values("overcast", "clear"),
                         [](const auto& room) { return room.param; });

}  // namespace
}  // namespace isolux
