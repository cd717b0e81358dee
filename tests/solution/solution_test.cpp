#include "isolux/solution/solution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/core/error.h"
#include "isolux/core/file.h"
#include "isolux/radiosity/solve.h"
#include "isolux/solution/glb.h"
#include "solution/small_solution.h"

namespace isolux {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(Solution, RoundTripKeepsEverything) {
  const TemporaryFolder folder;
  const Solution saved = small_solution();
  save_solution(saved, folder / "a.glb");
  const Solution loaded = load_solution(folder / "a.glb");

  EXPECT_EQ(loaded.version, saved.version);
  EXPECT_EQ(loaded.scene.source, saved.scene.source);
  EXPECT_EQ(loaded.scene.objects.size(), saved.scene.objects.size());
  EXPECT_EQ(loaded.options.seed, saved.options.seed);
  EXPECT_EQ(loaded.options.contrast, saved.options.contrast);
  EXPECT_EQ(loaded.options.camera, "front");
  EXPECT_EQ(loaded.mesh.rules().max_edge, 2);
  EXPECT_EQ(loaded.statistics.shadow_rays, saved.statistics.shadow_rays);
  EXPECT_EQ(loaded.statistics.unshot_flux, saved.statistics.unshot_flux);
  EXPECT_TRUE(loaded.statistics.converged);
  EXPECT_EQ(loaded.statistics.wall_seconds, 0) << "time is no part of a solution";

  ASSERT_EQ(loaded.mesh.vertices().size(), saved.mesh.vertices().size());
  for (VertexId v = 0; v < saved.mesh.vertices().size(); ++v) {
    const Vertex &a = saved.mesh.vertex(v), &b = loaded.mesh.vertex(v);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.surface, b.surface);
    EXPECT_EQ(a.irradiance, b.irradiance);
    EXPECT_EQ(a.reflectance, b.reflectance);
    EXPECT_EQ(a.on_light, b.on_light);
  }
  // All triangles are alive but the last, which is left out.
  ASSERT_EQ(loaded.mesh.triangles().size(), saved.mesh.triangles().size() - 1);
  for (TriangleId t = 0; t < loaded.mesh.triangles().size(); ++t) {
    const Triangle &a = saved.mesh.triangle(t), &b = loaded.mesh.triangle(t);
    EXPECT_EQ(a.vertices, b.vertices);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.area, b.area);
    EXPECT_EQ(a.emission, b.emission);
    EXPECT_EQ(a.shot, b.shot);
    EXPECT_EQ(a.on_light, b.on_light);
  }
}

TEST(Solution, ASolvedMeshComesBackValidWithAllItsEdges) {
  const TemporaryFolder folder;
  Solution saved = small_solution();
  saved.options = Options{};
  saved.options.method = Method::shooting;
  saved.options.rules.max_edge = 0.3;
  saved.options.iterations = 20;
  Solved solved = solve(saved.scene, saved.options);
  saved.mesh = std::move(solved.mesh);
  saved.statistics = solved.statistics;
  save_solution(saved, folder / "a.glb");
  const Solution loaded = load_solution(folder / "a.glb");
  EXPECT_THAT(loaded.mesh.validate(), ::testing::IsEmpty());
  for (VertexId v = 0; v < saved.mesh.vertices().size(); ++v) {
    EXPECT_THAT(loaded.mesh.vertex(v).neighbours,
                ::testing::UnorderedElementsAreArray(saved.mesh.vertex(v).neighbours));
  }
}

TEST(Solution, EqualSolutionsGiveEqualBytes) {
  const TemporaryFolder folder;
  Solution solution = small_solution();
  // Numbers that a float can't hold must not drift when saved again.
  for (Vertex& v : solution.mesh.vertices()) {
    v.irradiance = {1.0 / 3, 1e-9, 1e9 / 7};
    v.reflectance = {0.1, 0.2, 0.7};
    v.normal = normalized(v.normal + Vec3{0.1, 0.01, 0.03});
  }
  save_solution(solution, folder / "a.glb");
  solution.statistics.cpu_seconds = solution.statistics.wall_seconds = 99;
  save_solution(solution, folder / "b.glb");
  save_solution(load_solution(folder / "a.glb"), folder / "c.glb");
  const std::string bytes = read_file(folder / "a.glb");
  EXPECT_EQ(bytes, read_file(folder / "b.glb"));
  EXPECT_EQ(bytes, read_file(folder / "c.glb"));
}

TEST(Solution, IsGltfThatViewersCanShow) {
  const TemporaryFolder folder;
  save_solution(small_solution(), folder / "a.glb");
  const Glb glb = decode_glb(read_file(folder / "a.glb"));
  EXPECT_EQ(glb.json["asset"]["version"], "2.0");
  EXPECT_EQ(glb.json["buffers"].size(), 1u);
  EXPECT_EQ(glb.json["buffers"][0]["byteLength"], glb.binary.size());
  const auto& primitive = glb.json["meshes"][0]["primitives"][0];
  const auto& position = glb.json["accessors"][primitive["attributes"]["POSITION"].get<int>()];
  EXPECT_EQ(position["max"], (nlohmann::json{1.0, 1.0, 1.0}));
  const std::size_t n = position["count"].get<std::size_t>();
  for (const auto& [name, index] : primitive["attributes"].items()) {
    EXPECT_EQ(accessor_count(glb, index.get<std::uint64_t>()), n) << name;
  }
  for (const auto& view : glb.json["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 4, 0u);
  }
  EXPECT_EQ(glb.json["nodes"].size(), 3u) << "root, mesh, camera";
  EXPECT_EQ(glb.json["cameras"].size(), 1u);

  // The lamp's corners, the first four, are shown white; the walls at the mean.
  const auto colors =
      read_array<std::uint16_t>(glb, primitive["attributes"]["COLOR_0"].get<std::uint64_t>(), 4, n);
  EXPECT_EQ(glb.json["accessors"][primitive["attributes"]["COLOR_0"].get<int>()]["normalized"],
            true);
  EXPECT_EQ(colors[0], 65535);
  EXPECT_NEAR(colors[16], 0.3 * 65535, 1);
}

TEST(Solution, WhatCannotBeSavedLeavesNoFile) {
  const TemporaryFolder folder;
  Solution bright = small_solution();
  bright.mesh.vertex(0).irradiance = gray(1e39);
  EXPECT_THAT([&] { save_solution(bright, folder / "a.glb"); },
              ThrowsMessage<InputError>(HasSubstr("a.glb: can't be saved: it holds a number")));
  Solution empty = small_solution();
  empty.mesh = Triangulation(empty.options.rules, empty.scene.bounds());
  EXPECT_THAT([&] { save_solution(empty, folder / "a.glb"); },
              ThrowsMessage<InputError>(HasSubstr("no triangles")));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.glb"));
  EXPECT_THROW(save_solution(small_solution(), folder / "none/a.glb"), InputError);
}

}  // namespace
}  // namespace isolux
