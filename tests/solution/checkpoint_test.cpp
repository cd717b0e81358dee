#include "isolux/solution/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/core/error.h"
#include "isolux/radiosity/hemisphere_gather.h"
#include "isolux/radiosity/solve.h"
#include "solution/small_solution.h"

namespace isolux {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// A box with a window under a clear sky, and its solve.
class DaylitCheckpoint : public ::testing::Test {
 protected:
  void SetUp() override {
    options_.tolerance = 0.1;
    const auto keep = [&](const GatheringState& state) { states_.push_back(state); };
    for (const Vertex& v : solve_by_gathering(scene_, options_, {{}, keep}).mesh.vertices()) {
      whole_.push_back(v.irradiance);
    }
    ASSERT_GE(states_.size(), 2u);
  }

  GatheringState saved_and_loaded(const GatheringState& state) {
    save_checkpoint(scene_, options_, state, file_);
    return load_checkpoint(scene_, options_, file_);
  }

  /// A checkpoint that has this site too.
  void expect_refused(const Site& site) {
    GatheringState state = states_.front();
    state.sites.add(site);
    EXPECT_THAT([&] { saved_and_loaded(state); },
                ThrowsMessage<InputError>(
                    AllOf(HasSubstr("a.checkpoint"), HasSubstr("is damaged: 'sites'"))));
  }

  const Scene scene_ = read_scene(R"(isolux: 1
sky: {type: clear, sun: [0.3, -1, 1], illuminance: 12000, ground: 3000}
lights: [{directional: {direction: [-0.3, 1, -1], illuminance: 80000}}]
materials: {grey: {reflectance: 0.5}}
objects:
  - shape:
      difference:
        - box: {lower: [-0.2, -0.2, -0.2], upper: [2.2, 2.2, 2.2]}
        - box: {lower: [0, 0, 0], upper: [2, 2, 2]}
        - box: {lower: [0.5, -1, 0.8], upper: [1.5, 1, 1.6]}
    material: grey
)",
                                  "test");
  Options options_;
  std::vector<GatheringState> states_;
  std::vector<Rgb> whole_;
  const TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "a.checkpoint";
};

TEST_F(DaylitCheckpoint, GoesOnFromItsFileToTheSameBits) {
  for (const GatheringState& state : {states_.front(), states_[states_.size() / 2]}) {
    const Solved rest = solve_by_gathering(scene_, options_, {}, saved_and_loaded(state));
    std::vector<Rgb> light;
    for (const Vertex& v : rest.mesh.vertices()) light.push_back(v.irradiance);
    EXPECT_EQ(light, whole_);
  }
}

TEST_F(DaylitCheckpoint, SitesBeyondTheSkyAreRefused) {
  const std::uint32_t outside = HemisphereGather::outside_of(scene_);
  const std::uint32_t nodes = SkyDome::node_count();
  const auto vertices = static_cast<VertexId>(states_.front().mesh.vertices().size());
  GatheringState last = states_.front();
  last.sites.add({outside, {nodes - 1, nodes - 1, nodes - 1}});
  EXPECT_NO_THROW(saved_and_loaded(last));
  expect_refused({outside, {0, nodes, 0}});
  expect_refused({outside, {0, 0, 0xffffffff}});
  expect_refused({outside + 1, {0, 0, 0}});
  expect_refused({0, {vertices, 0, 0}});
}

}  // namespace
}  // namespace isolux
