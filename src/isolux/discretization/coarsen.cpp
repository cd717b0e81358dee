#include "isolux/discretization/coarsen.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <tuple>

namespace isolux {
namespace {

// Vertices of one subset and those near them in it.
using Graph = std::vector<std::vector<VertexId>>;  // by vertex

// The cosine of the largest angle between a vertex and those that it lies among.
constexpr double kFacing = 0.64;
// How far a vertex may lie beside the line between two others, in distances of these.
constexpr double kBeside = 0.12;
// Outlines that turn by more than the angle with this cosine have a corner.
constexpr double kStraight = 0.85;
constexpr std::size_t kNearest = 12;    // looked at for a place
constexpr std::size_t kNeighbours = 8;  // of a vertex in a coarser subset

struct Flat {
  double x, y;
};

double left_of(const Flat& a, const Flat& b) { return a.x * b.y - a.y * b.x; }
Flat operator-(const Flat& a, const Flat& b) { return {a.x - b.x, a.y - b.y}; }

/// Coarsens a mesh, subset by subset.
class Coarsener {
 public:
  explicit Coarsener(const Triangulation& mesh) : mesh_(mesh), graph_(mesh.vertices().size()) {
    link_triangles();
    find_outline();
  }

  Coarsening run(int levels) {
    Coarsening result;
    result.places.resize(mesh_.vertices().size());
    std::vector<VertexId> subset = by_rank();
    std::vector<VertexId> finest_first;
    for (int level = 0; level < levels; ++level) {
      const std::vector<VertexId> coarse = next_subset(subset, result.places);
      for (auto v = subset.rbegin(); v != subset.rend(); ++v) {
        if (!chosen_[*v]) finest_first.push_back(*v);
      }
      if (10 * coarse.size() > 9 * subset.size()) {
        subset = coarse;
        break;
      }
      graph_ = among(coarse);
      subset = coarse;
    }
    finest_first.insert(finest_first.end(), subset.rbegin(), subset.rend());
    result.order.assign(finest_first.rbegin(), finest_first.rend());
    return result;
  }

 private:
  const Vec3& at(VertexId v) const { return mesh_.vertex(v).position; }

  void link_triangles() {
    for (const Triangle& triangle : mesh_.triangles()) {
      if (!triangle.alive) continue;
      for (int k = 0; k < 3; ++k) {
        const VertexId a = triangle.vertices[k], b = triangle.vertices[(k + 1) % 3];
        graph_[a].push_back(b), graph_[b].push_back(a);
      }
    }
  }

  /// Ranks vertices: 0 for corners and loners, 1 along outlines of the mesh, 2 inside. An edge of
  /// two triangles is in the graph twice.
  void find_outline() {
    rank_.resize(graph_.size(), 2);
    for (VertexId v = 0; v < graph_.size(); ++v) {
      std::vector<VertexId>& around = graph_[v];
      std::sort(around.begin(), around.end());
      std::vector<VertexId> outer;
      for (const VertexId w : around) {
        if (std::count(around.begin(), around.end(), w) == 1) outer.push_back(w);
      }
      around.erase(std::unique(around.begin(), around.end()), around.end());
      if (around.empty() || outer.size() > 2) {
        rank_[v] = 0;
      } else if (outer.size() == 2) {
        const Vec3 in = normalized(at(v) - at(outer[0])), out = normalized(at(outer[1]) - at(v));
        rank_[v] = dot(in, out) < kStraight ? 0 : 1;
      }
    }
  }

  std::vector<VertexId> by_rank() const {
    std::vector<VertexId> all(graph_.size());
    std::iota(all.begin(), all.end(), 0);
    std::stable_sort(all.begin(), all.end(),
                     [&](VertexId a, VertexId b) { return rank_[a] < rank_[b]; });
    return all;
  }

  /// The next coarser subset, in the same order; gives all others their places among it.
  std::vector<VertexId> next_subset(const std::vector<VertexId>& subset,
                                    std::vector<MeshPlace>& places) {
    std::vector<char> near(graph_.size());
    chosen_.assign(graph_.size(), 0);
    for (const VertexId v : subset) {
      if (rank_[v] != 0 && near[v]) continue;
      chosen_[v] = 1;
      for (const VertexId w : graph_[v]) near[w] = 1;
    }
    for (const VertexId v : subset) {
      if (chosen_[v]) continue;
      if (const auto place = place_of(v)) {
        places[v] = *place;
      } else {
        chosen_[v] = 1;
      }
    }
    std::vector<VertexId> coarse;
    for (const VertexId v : subset) {
      if (chosen_[v]) coarse.push_back(v);
    }
    return coarse;
  }

  /// The chosen vertices within `hops` of v, nearest first, at most `most`, that face as it does.
  std::vector<VertexId> chosen_near(VertexId v, int hops, std::size_t most) const {
    std::vector<VertexId> found{v};
    std::size_t ring = 0;
    for (int hop = 0; hop < hops; ++hop) {
      const std::size_t end = found.size();
      for (; ring < end; ++ring) {
        for (const VertexId w : graph_[found[ring]]) {
          if (std::find(found.begin(), found.end(), w) == found.end()) found.push_back(w);
        }
      }
    }
    std::vector<std::pair<double, VertexId>> near;
    for (const VertexId w : found) {
      if (w == v || !chosen_[w]) continue;
      if (dot(mesh_.vertex(v).normal, mesh_.vertex(w).normal) < kFacing) continue;
      near.emplace_back(length_squared(at(w) - at(v)), w);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > most) near.resize(most);
    std::vector<VertexId> nearest;
    for (const auto& [squared, w] : near) nearest.push_back(w);
    return nearest;
  }

  /// Where v lies among the chosen, in its tangent plane: so that what interpolation makes of a
  /// bent function, Σ weight · distance², is least.
  std::optional<MeshPlace> place_of(VertexId v) const {
    const std::vector<VertexId> near = chosen_near(v, 2, kNearest);
    const Frame frame(mesh_.vertex(v).normal);
    std::vector<Flat> flat;
    std::vector<double> squared;
    for (const VertexId w : near) {
      const Vec3 d = at(w) - at(v);
      const double x = dot(d, frame.u), y = dot(d, frame.v);
      squared.push_back(length_squared(d));
      const double scale = std::sqrt(squared.back() / std::max(x * x + y * y, 1e-300));
      flat.push_back({x * scale, y * scale});
    }
    std::optional<MeshPlace> best;
    double least = std::numeric_limits<double>::infinity();
    const auto offer = [&](std::array<std::size_t, 3> k, std::array<double, 3> weights) {
      double sum = 0;
      for (std::size_t i = 0; i < 3; ++i) sum += weights[i] * squared[k[i]];
      if (sum >= least) return;
      least = sum;
      best = MeshPlace{{near[k[0]], near[k[1]], near[k[2]]}, weights};
    };
    for (std::size_t a = 0; a < near.size(); ++a) {
      for (std::size_t b = a + 1; b < near.size(); ++b) {
        const Flat along = flat[b] - flat[a];
        const double length2 = along.x * along.x + along.y * along.y;
        const double t = -(flat[a].x * along.x + flat[a].y * along.y) / length2;
        const double twice = left_of(flat[a], flat[b]);
        if (t > 0 && t < 1 && std::abs(twice) < kBeside * length2) {
          offer({a, b, a}, {1 - t, t, 0});
        }
        for (std::size_t c = b + 1; c < near.size(); ++c) {
          const double u = left_of(flat[b], flat[c]), w = left_of(flat[c], flat[a]);
          const double sum = u + w + twice;
          if (sum == 0 || u * sum < 0 || w * sum < 0 || twice * sum < 0) continue;
          offer({a, b, c}, {u / sum, w / sum, twice / sum});
        }
      }
    }
    return best;
  }

  /// The graph of a coarser subset.
  Graph among(const std::vector<VertexId>& coarse) const {
    Graph graph(graph_.size());
    for (const VertexId v : coarse) {
      for (const VertexId w : chosen_near(v, 3, kNeighbours)) {
        graph[v].push_back(w), graph[w].push_back(v);
      }
    }
    for (const VertexId v : coarse) {
      std::sort(graph[v].begin(), graph[v].end());
      graph[v].erase(std::unique(graph[v].begin(), graph[v].end()), graph[v].end());
    }
    return graph;
  }

  const Triangulation& mesh_;
  Graph graph_;                     // of the subset at hand
  std::vector<std::uint8_t> rank_;  // by vertex
  std::vector<char> chosen_;        // by vertex: in the next coarser subset
};

}  // namespace

Coarsening coarsen(const Triangulation& mesh, int levels) { return Coarsener(mesh).run(levels); }

}  // namespace isolux
