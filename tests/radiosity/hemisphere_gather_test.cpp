#include "isolux/radiosity/hemisphere_gather.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "support/meshes.h"
#include "support/scenes.h"

namespace isolux {
namespace {

Scene box_room(double side, double reflectance, double exitance) {
  return scene_of(fmt::format(
      "materials: {{m: {{reflectance: {1}}}}}\nobjects:\n"
      "  - {{shape: {{box: {{lower: [0, 0, 0], upper: [{0}, {0}, {0}], inward: true}}}}, material: "
      "m, emission: {{exitance: {2}}}}}\n",
      side, reflectance, exitance));
}

std::vector<Row<Landing>> rows_of(const HemisphereGather& gather,
                                  std::span<const Receiver> receivers, int grid,
                                  std::uint64_t seed) {
  std::vector<Row<Landing>> rows(receivers.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    gather.trace(receivers[i], grid, seed, i, rows[i]);
  }
  return rows;
}

/// Repeats E = direct + what the rows gather, until nothing changes by more than 1e-6 of it.
std::vector<Rgb> settle(const HemisphereGather& gather, std::span<const Row<Landing>> rows,
                        std::span<const Rgb> direct) {
  const std::size_t n = direct.size();
  std::vector<Rgb> irradiance(direct.begin(), direct.end()), next(n);
  for (double change = 1; change > 1e-6;) {
    change = 0;
    for (std::size_t i = 0; i < n; ++i) {
      next[i] = direct[i] + gather.gather(rows[i], irradiance);
      change = std::max(change, std::abs(next[i].g - irradiance[i].g) / next[i].g);
    }
    irradiance.swap(next);
  }
  return irradiance;
}

TEST(HemisphereGather, IsExactInAFurnaceWithAnyNumberOfRays) {
  // Every surface emits B₀ (1 − ρ) and reflects ρ: B = B₀ and E = B₀ everywhere.
  constexpr double kB0 = 7;
  for (const double rho : {0.2, 0.9}) {
    const Scene scene = box_room(1, rho, kB0 * (1 - rho));
    const RayCaster rays(scene);
    const Triangulation mesh = box_room_mesh({1, 1, 1}, 4, gray(rho));
    ASSERT_EQ(mesh.validate(), std::vector<std::string>{});
    const HemisphereGather gather(rays, mesh, std::vector<std::uint8_t>{0});
    const std::vector<Receiver> receivers = receivers_of(mesh);
    for (const int grid : {1, 2, 5}) {
      const auto rows = rows_of(gather, receivers, grid, 3);
      const std::vector<Rgb> zero(receivers.size());
      for (const Rgb& e : settle(gather, rows, zero)) EXPECT_NEAR(e.g, kB0, 1e-4 * kB0);
    }
  }
}

TEST(HemisphereGather, InterreflectionInACubeWithALampInItsMiddle) {
  ISOLUX_NEED_SHARED();
  std::ifstream in(shared_dir() / "validation/cases/cube_pointwise.json");
  const auto json = nlohmann::json::parse(in);
  // The lamp is a point: its direct light is put in by the inverse square of the distance.
  const auto direct_at = [](const Receiver& r) {
    const Vec3 d = Vec3{2, 2, 2} - r.point;
    return gray(10000 / (4 * std::numbers::pi) * dot(d, r.normal) / std::pow(length(d), 3));
  };
  for (const double rho : {0.2, 0.5, 0.8}) {
    const Scene scene = box_room(4, rho, 0);
    const RayCaster rays(scene);
    const Triangulation mesh = box_room_mesh({4, 4, 4}, 48, gray(rho));
    const HemisphereGather gather(rays, mesh, std::vector<std::uint8_t>{0});
    const std::vector<Receiver> receivers = receivers_of(mesh);
    std::vector<Rgb> direct;
    for (const Receiver& r : receivers) direct.push_back(direct_at(r));
    const auto rows = rows_of(gather, receivers, 8, 1);
    const std::vector<Rgb> irradiance = settle(gather, rows, direct);

    const auto& expected = json.at("expected").at("values").at(fmt::format("R1cube_rho{}", rho));
    Row<Landing> row;
    for (const auto& point : json.at("points")) {
      const Receiver receiver{{point.at("pos")[0], point.at("pos")[1], 0}, {0, 0, 1}};
      gather.trace(receiver, 64, 2, 0, row);
      const double found = direct_at(receiver).g + gather.gather(row, irradiance).g;
      const double value = expected.at(point.at("id").get<std::string>()).at("value");
      EXPECT_NEAR(found, value, 0.005 * value) << rho << " " << point.at("id");
    }
  }
}

TEST(HemisphereGather, ErrorsAreHonest) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  // Light that changes steadily over the walls, with a jump at the edges; the ball and its pedestal
  // are left without triangles, so that their light comes from the walls' nearest vertices.
  Triangulation mesh = box_room_mesh({1, 1, 1}, 10, gray(0.6));
  std::vector<Rgb> irradiance;
  for (const Vertex& v : mesh.vertices()) {
    irradiance.push_back(gray(1 + std::sin(5 * v.position.x) + 2 * v.position.z));
  }
  const HemisphereGather gather(rays, mesh, std::vector<std::uint8_t>(4, 0));
  for (const int grid : {4, 8, 20}) {
    constexpr int kRuns = 40;
    double spread = 0, estimated = 0;
    Row<Landing> row;
    for (std::size_t i = 0; i < mesh.vertices().size(); i += 31) {
      const Vertex& vertex = mesh.vertices()[i];
      double sum = 0, squares = 0;
      for (std::uint64_t run = 0; run < kRuns; ++run) {
        gather.trace({vertex.gather_point, vertex.normal}, grid, run, i, row);
        const Gathered gathered = gather.gather_with_error(row, irradiance);
        const double e = luminance(gathered.irradiance);
        EXPECT_NEAR(e, luminance(gather.gather(row, irradiance)), 1e-12 * e);
        sum += e, squares += e * e;
        estimated += gathered.error * gathered.error / kRuns;
      }
      spread += (squares - sum * sum / kRuns) / (kRuns - 1);
    }
    const double ratio = std::sqrt(estimated / spread);
    EXPECT_GT(ratio, 0.8) << grid;
    EXPECT_LT(ratio, 1.6) << grid;
  }
}

/// What many rows of the grid find from a receiver: their mean, their spread, and the root mean
/// square of their errors.
struct Found {
  double mean, spread, error, rays;
};

Found many_rows(const HemisphereGather& gather, const Receiver& receiver, int grid,
                std::span<const Rgb> irradiance) {
  constexpr int kRuns = 100;
  Row<Landing> row;
  double sum = 0, squares = 0, variances = 0, rays = 0;
  for (std::uint64_t run = 0; run < kRuns; ++run) {
    gather.trace(receiver, grid, run, 0, row);
    const Gathered gathered = gather.gather_with_error(row, irradiance);
    const double e = luminance(gathered.irradiance);
    EXPECT_NEAR(e, luminance(gather.gather(row, irradiance)), 1e-12 * e);
    sum += e, squares += e * e, variances += gathered.error * gathered.error;
    rays += double(row.rays.size());
  }
  return {sum / kRuns, std::sqrt((squares - sum * sum / kRuns) / (kRuns - 1)),
          std::sqrt(variances / kRuns), rays / kRuns};
}

TEST(HemisphereGather, FacesCloserThanTheMeshAreAsDarkAsOneAnother) {
  // The floor's vertices stand at the rim, in the light; the ceiling's are in the dark. Where the
  // ceiling is so low that no vertex of the floor is near what it sees, nor is light.
  const auto under_a_ceiling_at = [](double height) {
    const Scene scene = scene_of(fmt::format(
        "materials: {{m: {{reflectance: 0.5}}}}\nobjects:\n"
        "  - {{shape: {{box: {{lower: [0, 0, 0], upper: [1, 1, {}], inward: true}}}}, material: "
        "m}}\n",
        height));
    const RayCaster rays(scene);
    const Triangulation mesh = box_room_mesh({1, 1, height}, 1, gray(0.5));
    std::vector<Rgb> irradiance;
    for (const Vertex& v : mesh.vertices()) irradiance.push_back(gray(v.normal.z > 0.5 ? 2 : 0));
    const HemisphereGather gather(rays, mesh, std::vector<std::uint8_t>{0});
    Row<Landing> row;
    gather.trace({{0.45, 0.4, height}, {0, 0, -1}}, 40, 1, 0, row);
    return gather.gather(row, irradiance).g;
  };
  EXPECT_LT(under_a_ceiling_at(0.01), 0.05);
  // From the ceiling of a cube the floor is seen as it is: the form factors of the four rectangles
  // into which the receiver's foot cuts it.
  EXPECT_NEAR(under_a_ceiling_at(1), 0.2361, 0.003);
}

TEST(HemisphereGather, CellsTowardsSmallBrightPlacesAreDivided) {
  // Under a ceiling with two small spots, forty times as bright as the rest.
  const Scene scene = box_room(1, 0.6, 0);
  const RayCaster rays(scene);
  const Triangulation mesh = box_room_mesh({1, 1, 1}, 40, gray(0.6));
  std::vector<Rgb> irradiance;
  for (const Vertex& v : mesh.vertices()) {
    const bool spot = v.position.z > 0.999 && (distance(v.position, {0.2, 0.3, 1}) < 0.03 ||
                                               distance(v.position, {0.775, 0.6, 1}) < 0.03);
    irradiance.push_back(gray(spot ? 40 : 1));
  }
  const std::vector<std::uint8_t> none{0};
  const HemisphereGather plain(rays, mesh, none), dividing(rays, mesh, none, irradiance);
  for (const Receiver& receiver :
       {Receiver{{0.5, 0.5, 0}, {0, 0, 1}}, Receiver{{0.1, 0.35, 0}, {0, 0, 1}},
        Receiver{{0, 0.45, 0.6}, {1, 0, 0}}}) {
    const Found truth = many_rows(plain, receiver, 64, irradiance);
    const Found without = many_rows(plain, receiver, 12, irradiance);
    const Found found = many_rows(dividing, receiver, 12, irradiance);
    EXPECT_NEAR(found.mean, truth.mean, 4 * (found.spread + truth.spread) / std::sqrt(100.0));
    EXPECT_LT(found.spread, without.spread / 4);
    EXPECT_LT(found.rays, 3 * 144);
    EXPECT_GT(found.error, 0.7 * found.spread);
    EXPECT_LT(found.error, 2 * found.spread);
  }
  // What is seen from within a spot is not far brighter than the light there.
  Row<Landing> row;
  dividing.trace({{0.2, 0.3, 1}, {0, 0, -1}}, 12, 1, 0, row);
  EXPECT_TRUE(row.divided.empty());
}

}  // namespace
}  // namespace isolux
