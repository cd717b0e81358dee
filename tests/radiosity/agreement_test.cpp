#include <gtest/gtest.h>

#include "isolux/radiosity/elements.h"
#include "isolux/radiosity/full_matrix.h"
#include "isolux/radiosity/plain_progressive.h"
#include "isolux/radiosity/solve.h"
#include "support/scenes.h"

namespace isolux {
namespace {

/// A mesh that the method itself grew, its light taken away again.
Triangulation fixed_mesh(const Scene& scene) {
  Options options;
  options.method = Method::shooting;
  options.rules = {0.35, 5e-3, 0.52};
  options.iterations = 4;
  options.grid = 12;
  Triangulation mesh = solve(scene, options).mesh;
  for (Vertex& vertex : mesh.vertices()) vertex.irradiance = vertex.delta_irradiance = {};
  for (Triangle& triangle : mesh.triangles()) triangle.shot = {};
  return mesh;
}

double relative_difference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max({largest, a[i].r, a[i].g, a[i].b});
    const Rgb d = a[i] - b[i];
    difference = std::max({difference, std::abs(d.r), std::abs(d.g), std::abs(d.b)});
  }
  return difference / largest;
}

TEST(Agreement, ThreeRoadsToTheRadiosityOfOneMesh) {
  const Scene scene = scene_of(R"(
materials:
  red: {reflectance: [0.7, 0.3, 0.2]}
  white: {reflectance: 0.8}
  lamp: {reflectance: 0.1}
objects:
  - {shape: {box: {lower: [0, 0, 0], upper: [1, 1, 1], inward: true}}, material: red}
  - {shape: {sphere: {center: [0.4, 0.6, 0.3], radius: 0.25}}, material: white}
  - {shape: {parallelogram: {corner: [0.3, 0.3, 1], u: [0, 0.4, 0], v: [0.4, 0, 0]}}, material: lamp, sides: front, emission: {exitance: [10, 20, 30]}}
)");
  const RayCaster rays(scene);
  Triangulation mesh = fixed_mesh(scene);
  const int subdivisions = Options{}.subdivisions;
  const Eigen::MatrixXd factors = form_factor_matrix(mesh, rays, subdivisions);
  ASSERT_GT(factors.rows(), 100);
  EXPECT_LE(factors.rowwise().sum().maxCoeff(), 1.02) << "nobody sees more than everything";

  const std::vector<Rgb> matrix = full_matrix_radiosity(mesh, factors, 1e-9);
  const std::vector<Rgb> plain = plain_progressive_radiosity(mesh, factors, 1e-6);

  Options options;
  options.method = Method::shooting;
  options.refine = false;
  options.eye_grid = 0;
  options.selection = Selection::power;
  options.iterations = 1000000;
  options.stop_at_unshot = 1e-5;
  const Statistics statistics = transfer_energy(mesh, rays, options);
  EXPECT_TRUE(statistics.converged);
  std::vector<Rgb> paper;
  for (const Element& element : elements_of(mesh)) {
    Rgb b = element.emission;
    for (VertexId v : mesh.triangle(element.triangle).vertices) {
      b += mesh.vertex(v).radiosity() / 3;
    }
    paper.push_back(b);
  }
  EXPECT_LT(relative_difference(matrix, plain), 1e-3);
  EXPECT_LT(relative_difference(matrix, paper), 1e-3);
}

TEST(Agreement, GaussSeidelSolvesTheSystem) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  const Triangulation mesh = fixed_mesh(scene);
  const Eigen::MatrixXd factors = form_factor_matrix(mesh, rays, 1);
  const std::vector<Element> elements = elements_of(mesh);
  const auto n = factors.rows();
  Eigen::MatrixXd system = Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd emission(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    system.row(i) -= elements[i].reflectance.g * factors.row(i);
    emission[i] = elements[i].emission.g;
  }
  const Eigen::VectorXd direct = system.partialPivLu().solve(emission);
  const std::vector<Rgb> iterated = full_matrix_radiosity(mesh, factors, 1e-12);
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_NEAR(iterated[i].g, direct[i], 1e-8 * direct.maxCoeff());
  }
}

}  // namespace
}  // namespace isolux
