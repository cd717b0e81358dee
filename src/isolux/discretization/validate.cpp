#include <fmt/format.h>

#include <set>

#include "isolux/discretization/triangulation.h"

namespace isolux {
namespace {

constexpr std::size_t kMostLines = 20;

/// Collects a line for each violation.
class Report {
 public:
  template <typename... Args>
  void check(bool holds, fmt::format_string<Args...> text, Args&&... args) {
    if (!holds && lines.size() < kMostLines) {
      lines.push_back(fmt::format(text, std::forward<Args>(args)...));
    }
  }
  std::vector<std::string> lines;
};

template <typename T>
bool contains(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

bool finite(const Rgb& c) { return is_finite(c); }

}  // namespace

std::vector<std::string> Triangulation::validate() const {
  Report report;
  // A mesh that was saved and loaded has been through single precision.
  constexpr double kRounding = 1e-6;
  const double longest = rules_.max_edge * (1 + kRounding);

  for (VertexId v = 0; v < vertices_.size(); ++v) {
    const Vertex& vertex = vertices_[v];
    report.check(
        is_finite(vertex.position) && finite(vertex.irradiance) && finite(vertex.delta_irradiance),
        "vertex {} has a value that is not finite", v);
    report.check(std::abs(length(vertex.normal) - 1) < kRounding,
                 "vertex {}: normal not of length 1", v);
    std::vector<std::uint32_t> there;
    grid_.query(vertex.position, 0, there);
    report.check(contains(there, v), "vertex {} is not in its voxel", v);
    std::set<VertexId> seen;
    for (VertexId w : vertex.neighbours) {
      if (w >= vertices_.size()) {
        report.check(false, "vertex {}: edge to nowhere", v);
        continue;
      }
      report.check(w != v && seen.insert(w).second, "vertex {}: edge to {} repeated or a loop", v,
                   w);
      report.check(contains(vertices_[w].neighbours, v), "edge {}–{} is known at one end only", v,
                   w);
      report.check(vertex.on_light == vertices_[w].on_light, "edge {}–{} leaves a light", v, w);
      report.check(vertex.on_light || distance(vertex.position, vertices_[w].position) <= longest,
                   "edge {}–{} is longer than δ (rule 1)", v, w);
    }
    for (TriangleId t : vertex.triangles) {
      report.check(
          t < triangles_.size() && triangles_[t].alive &&
              std::count(triangles_[t].vertices.begin(), triangles_[t].vertices.end(), v) == 1,
          "vertex {} lists triangle {}, which is not around it", v, t);
    }
  }

  std::size_t alive = 0;
  std::set<std::pair<VertexId, VertexId>> half_edges;
  for (TriangleId t = 0; t < triangles_.size(); ++t) {
    const Triangle& triangle = triangles_[t];
    if (!triangle.alive) continue;
    ++alive;
    const auto& v = triangle.vertices;
    if (std::max({v[0], v[1], v[2]}) >= vertices_.size() || v[0] == v[1] || v[1] == v[2] ||
        v[2] == v[0]) {
      report.check(false, "triangle {} lacks three vertices", t);
      continue;
    }
    const Vec3 twice_area = cross(vertices_[v[1]].position - vertices_[v[0]].position,
                                  vertices_[v[2]].position - vertices_[v[0]].position);
    report.check(triangle.area > 0, "triangle {} has no area", t);
    report.check(std::abs(length(twice_area) / 2 - triangle.area) <= 1e-9 * triangle.area,
                 "triangle {}: wrong area", t);
    report.check(dot(twice_area, triangle.normal) > 0, "triangle {}: wound against its normal", t);
    report.check(finite(triangle.shot) && finite(triangle.emission),
                 "triangle {} has a value that is not finite", t);
    for (int k = 0; k < 3; ++k) {
      const VertexId a = v[k], b = v[(k + 1) % 3];
      report.check(contains(vertices_[a].triangles, t), "triangle {} is unknown to vertex {}", t,
                   a);
      report.check(has_edge(a, b), "triangle {}: side {}–{} is no edge", t, a, b);
      report.check(vertices_[a].on_light == triangle.on_light, "triangle {} leaves a light", t);
      report.check(triangle.on_light || dot(vertices_[a].normal, vertices_[b].normal) >=
                                            cos_normal_tolerance_ - kRounding,
                   "triangle {}: normals of {} and {} differ by more than α_n (rule 4)", t, a, b);
      report.check(half_edges.insert({a, b}).second,
                   "edge {}–{} has two triangles on one side (the other is not {})", a, b, t);
    }
  }
  report.check(alive == alive_, "{} triangles are alive, {} are counted", alive, alive_);
  return report.lines;
}

}  // namespace isolux
