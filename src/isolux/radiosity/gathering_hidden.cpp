#include <algorithm>
#include <cmath>

#include "isolux/radiosity/gathering_procedure.h"

namespace isolux {
namespace {

// A sheet that lies closer over a surface than this part of an edge hides the edge's middle, and
// closer than this part of the size of the triangles around a vertex, the vertex.
constexpr double kCloseToEdge = 0.1;
constexpr double kCloseToVertex = 0.02;

}  // namespace

/// Whether something lies over the point, less than `far` (m) from it.
bool Gathering::covered(const SurfacePoint& point, double far) const {
  const double near = 8 * rays_.epsilon();
  return far > near && rays_.occluded({point.position + point.normal * near,
                                       point.position + point.normal * far});
}

/// Whether the point in the middle of an edge is on a sheet that goes on hidden under the one that
/// is seen, as where a board's edge is a tube: it is covered, and its ends are not, or have light
/// from beside.
bool Gathering::hidden(const SurfacePoint& middle, const Edge& edge) const {
  const Vertex &a = mesh_.vertex(edge.a), &b = mesh_.vertex(edge.b);
  const double far = kCloseToEdge * distance(a.position, b.position);
  if (!covered(middle, far)) return false;
  if (a.hidden || b.hidden) return true;
  return !covered(a, far) && !covered(b, far);
}

/// Whether what covers the first point, close by, opens on the way to the second, as under a ball:
/// the dark there can be seen from beside.
bool Gathering::touched_beside(const SurfacePoint& point, const SurfacePoint& other) const {
  constexpr double kOpening = 2;  // times as wide, at a quarter of the way and at half
  const Vec3 way = other.position - point.position;
  const auto gap = [&](double part) {
    const auto hit =
        rays_.nearest({point.position + way * part, point.normal}, {rays_.epsilon(), length(way)});
    return hit ? hit->t : -1;
  };
  const double here = gap(0), quarter = gap(0.25), half = gap(0.5);
  return quarter > kOpening * here && half > kOpening * quarter;
}

/// By vertex: of those that lie hidden but have neighbours that nothing covers nearer than they
/// are, up to three of these. Their triangles reach out from under the sheet that covers them, as
/// on a ceiling over a lamp, and would be seen to be dark. Where bodies touch, neighbours are
/// covered too.
std::vector<MeshPlace> Gathering::seen_beside_hidden() {
  constexpr double kFacing = 0.7;  // cosine
  std::vector<char> dark(mesh_.vertices().size());
  const std::vector<double> areas = areas_around();
  parallel_for(dark.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vertex& vertex = mesh_.vertex(static_cast<VertexId>(v));
      dark[v] = !vertex.on_light && covered(vertex, kCloseToVertex * std::sqrt(areas[v]));
    }
  });
  std::vector<MeshPlace> places(dark.size());
  std::vector<std::pair<double, VertexId>> seen;
  for (VertexId v = 0; v < dark.size(); ++v) {
    if (!dark[v]) continue;
    const Vertex& vertex = mesh_.vertex(v);
    seen.clear();
    for (const TriangleId t : vertex.triangles) {
      for (const VertexId w : mesh_.triangle(t).vertices) {
        const Vertex& other = mesh_.vertex(w);
        if (dark[w] || dot(vertex.normal, other.normal) < kFacing) continue;
        const double away = distance(vertex.position, other.position);
        if (covered(other, away) || touched_beside(vertex, other)) continue;
        seen.emplace_back(square(away), w);
      }
    }
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    double sum = 0;
    for (std::size_t k = 0; k < std::min<std::size_t>(seen.size(), 3); ++k) {
      places[v].vertices[k] = seen[k].second;
      sum += places[v].weights[k] = 1 / seen[k].first;
    }
    for (double& weight : places[v].weights) weight = sum > 0 ? weight / sum : 0;
  }
  return places;
}

/// Lets vertices lie among those of coarser subsets, and hidden ones among those seen beside them.
void Gathering::give_places(const Coarsening& subsets) {
  constexpr double kEnough = 0.5;  // of the weights left, or it gathers by itself
  const std::vector<MeshPlace> beside = seen_beside_hidden();
  for (VertexId v = 0; v < beside.size(); ++v) {
    mesh_.vertex(v).hidden = beside[v].weights[0] > 0;
  }
  for (const VertexId v : subsets.order) {
    if (mesh_.vertex(v).hidden) continue;
    MeshPlace among = subsets.places[v];
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh_.vertex(among.vertices[k]).hidden) among.weights[k] = 0;
      sum += among.weights[k];
    }
    for (double& weight : among.weights) weight = sum > kEnough ? weight / sum : 0;
    state_.give_parents(v, among);
  }
  for (VertexId v = 0; v < beside.size(); ++v) {
    if (mesh_.vertex(v).hidden) state_.give_parents(v, beside[v]);
  }
}

/// E_d of hidden vertices, from those that are seen beside them.
void Gathering::light_hidden() {
  for (VertexId v = 0; v < state_.light.size(); ++v) {
    if (!mesh_.vertex(v).hidden) continue;
    VertexLight& light = state_.light[v];
    light.direct = {};
    double variance = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = light.among.weights[k];
      if (w == 0) continue;
      const VertexLight& seen = state_.light[light.among.vertices[k]];
      light.direct += seen.direct * w;
      variance += square(w * seen.direct_deviation);
    }
    light.direct_deviation = std::sqrt(variance);
    sum_up(v);
  }
}

}  // namespace isolux
