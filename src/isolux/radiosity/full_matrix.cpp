#include "isolux/radiosity/full_matrix.h"

#include "isolux/core/parallel.h"
#include "isolux/radiosity/elements.h"
#include "isolux/radiosity/visibility.h"

namespace isolux {

Eigen::MatrixXd form_factor_matrix(const Triangulation& mesh, const RayCaster& rays,
                                   int subdivisions) {
  const std::vector<Element> elements = elements_of(mesh);
  const auto n = static_cast<Eigen::Index>(elements.size());
  std::vector<Receiver> receivers;
  for (const Vertex& vertex : mesh.vertices()) {
    receivers.push_back({vertex.gather_point, vertex.normal});
  }
  Eigen::MatrixXd factors(n, n);
  parallel_for(elements.size(), 1, [&](std::size_t j, std::size_t) {
    std::vector<double> at_vertices(receivers.size());
    visible_form_factors(rays, emitter_of(mesh, elements[j].triangle), receivers, subdivisions,
                         at_vertices);
    for (Eigen::Index i = 0; i < n; ++i) {
      double sum = 0;
      for (VertexId v : mesh.triangle(elements[i].triangle).vertices) sum += at_vertices[v];
      factors(i, static_cast<Eigen::Index>(j)) = sum / 3;
    }
  });
  return factors;
}

std::vector<Rgb> full_matrix_radiosity(const Triangulation& mesh, const Eigen::MatrixXd& factors,
                                       double tolerance) {
  const std::vector<Element> elements = elements_of(mesh);
  const auto n = static_cast<Eigen::Index>(elements.size());
  Eigen::MatrixX3d radiosity = Eigen::MatrixX3d::Zero(n, 3);
  for (double change = 1; change > tolerance * radiosity.cwiseAbs().maxCoeff();) {
    change = 0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Element& element = elements[i];
      const Eigen::RowVector3d arriving = factors.row(i) * radiosity;
      const Rgb b =
          element.emission + element.reflectance * Rgb{arriving[0], arriving[1], arriving[2]};
      const Eigen::RowVector3d value(b.r, b.g, b.b);
      change = std::max(change, (value - radiosity.row(i)).cwiseAbs().maxCoeff());
      radiosity.row(i) = value;
    }
    if (change == 0) break;
  }
  std::vector<Rgb> result;
  for (Eigen::Index i = 0; i < n; ++i) {
    result.push_back({radiosity(i, 0), radiosity(i, 1), radiosity(i, 2)});
  }
  return result;
}

}  // namespace isolux
