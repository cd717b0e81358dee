#include "isolux/discretization/interpolation.h"

#include <gtest/gtest.h>

namespace isolux {
namespace {

SurfacePoint flat(double x, double y) { return {{x, y, 0}, {0, 0, 1}, {0, 0}, gray(0.5)}; }

/// Four vertices around the origin, with the light that `light` gives them.
template <typename Light>
Triangulation cross(Light light) {
  Triangulation mesh({1, 1e-6, 0.5}, {{-1, -1, -1}, {1, 1, 1}});
  for (const auto& [x, y] : {std::pair(0.4, 0.0), {0.0, 0.4}, {-0.4, 0.0}, {0.0, -0.4}}) {
    const VertexId v = mesh.extend(flat(x, y)).value();
    mesh.vertex(v).irradiance = gray(light(x, y));
  }
  return mesh;
}

TEST(Interpolation, IsLinearInATriangle) {
  const Triangulation mesh = cross([](double x, double y) { return 1 + 2 * x + 3 * y; });
  const TriangleId triangle = mesh.triangle_at(0, 1).value();
  const MeshPlace place = place_in(mesh, triangle, {0.2, 0.1, 0});
  EXPECT_NEAR(interpolate_irradiance(mesh, place).r, 1 + 2 * 0.2 + 3 * 0.1, 1e-12);
}

TEST(Interpolation, OfAPointNextToATriangleIsThatOfItsSide) {
  const Triangulation mesh = cross([](double x, double y) { return 1 + 2 * x + 3 * y; });
  const MeshPlace place =
      place_in(mesh, mesh.triangle_at(0, 1).value(), {0.2 + 1e-9, 0.2 + 1e-9, 0});
  EXPECT_NEAR(place.weights[0] + place.weights[1] + place.weights[2], 1, 1e-12);
  for (const double w : place.weights) EXPECT_GE(w, 0);
  EXPECT_NEAR(interpolate_irradiance(mesh, place).r, 2, 1e-7);
}

TEST(Extrapolation, OfEqualLightIsThatLight) {
  const Triangulation mesh = cross([](double, double) { return 7; });
  const SurfacePoint point = flat(0.05, 0.61);
  EXPECT_NEAR(extrapolate_irradiance(mesh, point, mesh.connectable(point)).g, 7, 1e-12);
}

TEST(Extrapolation, WeighsNearNeighboursMoreAndEqualOnesEqually) {
  const Triangulation mesh = cross([](double x, double) { return x > 0.1 ? 1 : 0; });
  const std::vector<VertexId> all{0, 1, 2, 3};
  EXPECT_NEAR(extrapolate_irradiance(mesh, flat(0, 0), all).r, 0.25, 1e-12);
  EXPECT_GT(extrapolate_irradiance(mesh, flat(0.3, 0), all).r, 0.5);
  EXPECT_LT(extrapolate_irradiance(mesh, flat(-0.3, 0), all).r, 0.25);
}

TEST(Extrapolation, WithoutNeighboursIsDark) {
  const Triangulation mesh = cross([](double, double) { return 7; });
  EXPECT_EQ(extrapolate_irradiance(mesh, flat(0, 0), {}), Rgb{});
}

TEST(Extrapolation, CanLeaveTheCurrentShotOut) {
  Triangulation mesh = cross([](double, double) { return 7; });
  for (Vertex& v : mesh.vertices()) v.delta_irradiance = gray(2);
  const std::vector<VertexId> all{0, 1, 2, 3};
  EXPECT_NEAR(extrapolate_irradiance(mesh, flat(0, 0), all, true).b, 5, 1e-12);
}

}  // namespace
}  // namespace isolux
