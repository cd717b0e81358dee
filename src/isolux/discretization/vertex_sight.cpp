#include "isolux/discretization/vertex_sight.h"

#include <algorithm>

#include "isolux/core/parallel.h"

namespace isolux {
namespace {

/// By vertex: how far from it what lies over it may stand for it to be covered, m.
std::vector<double> reaches(const Triangulation& mesh, std::span<const Facet> facets) {
  constexpr double kCovered = 0.03;  // of the longest side of its triangles
  std::vector<double> reach(mesh.vertices().size());
  for (const Facet& facet : facets) {
    double longest = 0;
    const auto at = [&](std::size_t k) { return mesh.vertex(facet.vertices[k % 3]).position; };
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, distance(at(k), at(k + 1)));
    for (const VertexId v : facet.vertices) reach[v] = std::max(reach[v], kCovered * longest);
  }
  return reach;
}

}  // namespace

VertexSight::VertexSight(const Triangulation& mesh, const FacetGrids& grids, const RayCaster& rays)
    : mesh_(mesh), grids_(grids), walk_(rays, mesh.rules().normal_tolerance) {
  const std::vector<double> reach = reaches(mesh, grids.facets());
  covered_vertices_.resize(reach.size());
  const double near = 2 * rays.epsilon();
  parallel_for(reach.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vertex& vertex = mesh.vertex(static_cast<VertexId>(v));
      covered_vertices_[v] =
          reach[v] > near && rays.occluded({vertex.position + vertex.normal * near,
                                            vertex.position + vertex.normal * reach[v]});
    }
  });
  for (const Facet& facet : grids.facets()) {
    covered_.push_back(
        std::ranges::any_of(facet.vertices, [&](VertexId v) { return covered_vertices_[v]; }));
  }
}

bool VertexSight::in_sheet(const SurfacePoint& from, const Facet& facet) const {
  const auto at = [&](std::size_t k) -> const Vertex& {
    return mesh_.vertex(facet.vertices[k % 3]);
  };
  double turned = 0, longest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    turned = std::max(turned, length(cross(at(k).normal, at(k + 1).normal)));
    longest = std::max(longest, distance(at(k).position, at(k + 1).position));
  }
  const Vec3 normal =
      normalized(cross(at(1).position - at(0).position, at(2).position - at(0).position));
  const double height = std::abs(dot(from.position - at(0).position, normal));
  return height <= hair() + turned * longest;
}

/// Whether one lies in the tangent plane of the other, as far as they are turned from each other.
bool VertexSight::in_one_sheet(const SurfacePoint& a, const SurfacePoint& b) const {
  const Vec3 d = b.position - a.position;
  return std::abs(dot(d, a.normal)) <= hair() + length(d) * length(cross(a.normal, b.normal));
}

std::optional<MeshPlace> VertexSight::place(const SurfacePoint& from) const {
  constexpr double kLittle = 1e-3, kEnough = 0.5;  // of the weights
  const Vec3 from_middle = from.position - grids_.middle();
  const Vec3f p = narrow(from_middle), n = narrow(from.normal);
  thread_local std::vector<FacetOver> candidates;
  candidates.clear();
  for (int grid = 0; grid < grids_.count(); ++grid) {
    for (const std::uint32_t index : grids_.voxels().find(grids_.voxel_of(from_middle, grid))) {
      const auto found = over(grids_.facets()[index], index, p, n);
      if (found) candidates.push_back(*found);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  const bool in_first =
      !candidates.empty() && in_sheet(from, grids_.facets()[candidates.front().facet]);
  std::optional<MeshPlace> best;
  double most = kEnough;
  for (const FacetOver& candidate : candidates) {
    MeshPlace place = place_in(grids_.facets()[candidate.facet], candidate.weights);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      double& w = place.weights[k];
      const VertexId v = place.vertices[k];
      // In the sheet that the point is on, a vertex that nothing covers is in sight.
      const bool plain = &candidate == candidates.data() && !covered_vertices_[v] && in_first;
      if (w < kLittle || !(plain || sees(from, v))) w = 0;
      sum += w;
    }
    if (sum <= most) continue;
    most = sum;
    for (double& w : place.weights) w /= sum;
    best = place;
    if (sum > 1 - 3 * kLittle) break;
  }
  return best;
}

}  // namespace isolux
