#include "isolux/discretization/interpolation.h"

#include <algorithm>
#include <numbers>

namespace isolux {

MeshPlace place_in(const Triangulation& mesh, TriangleId triangle, const Vec3& point) {
  MeshPlace place{mesh.triangle(triangle).vertices, {}};
  const auto corner = [&](std::size_t k) { return mesh.vertex(place.vertices[k]).position; };
  const Vec3 normal = cross(corner(1) - corner(0), corner(2) - corner(0));
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 next = corner((k + 1) % 3), last = corner((k + 2) % 3);
    sum += place.weights[k] = std::max(dot(cross(last - next, point - next), normal), 0.0);
  }
  for (double& w : place.weights) w /= sum;
  return place;
}

Rgb interpolate_irradiance(const Triangulation& mesh, const MeshPlace& place) {
  Rgb sum;
  for (std::size_t k = 0; k < 3; ++k) {
    sum += mesh.vertex(place.vertices[k]).irradiance * place.weights[k];
  }
  return sum;
}

Rgb extrapolate_irradiance(const Triangulation& mesh, const SurfacePoint& point,
                           std::span<const VertexId> neighbours, bool before_current_shot) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const Frame frame(point.normal);
  std::vector<std::pair<double, VertexId>> around;
  for (VertexId w : neighbours) {
    const Vec3 d = mesh.vertex(w).position - point.position;
    around.emplace_back(std::atan2(dot(d, frame.v), dot(d, frame.u)), w);
  }
  std::sort(around.begin(), around.end());

  Rgb sum;
  double weights = 0;
  const std::size_t n = around.size();
  for (std::size_t i = 0; i < n; ++i) {
    // An edge covers the angle from its predecessor to its successor, at most half a turn.
    double covered = around[(i + 1) % n].first - around[(i + n - 1) % n].first;
    if (covered <= 0) covered += kTurn;
    covered = std::min(covered, kTurn / 2) + 1e-3;
    const Vertex& w = mesh.vertex(around[i].second);
    const double weight = covered / std::max(distance(w.position, point.position), 1e-300);
    sum += (before_current_shot ? w.irradiance - w.delta_irradiance : w.irradiance) * weight;
    weights += weight;
  }
  return weights > 0 ? sum / weights : Rgb{};
}

}  // namespace isolux
