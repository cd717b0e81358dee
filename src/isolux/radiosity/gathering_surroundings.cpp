#include <algorithm>

#include "isolux/radiosity/gathering_procedure.h"

namespace isolux {

/// Under a sky a room may be a hundred times darker than what is outside, and a hundred times
/// smaller: there each vertex is judged by what it sees. Known for the vertices that are there now;
/// later ones go by those that they lie among.
void Gathering::look_around() {
  if (!rays_.scene().sky) return;
  const std::span<const Site> sites = state_.sites.sites();
  const auto in_mesh = [&](const Site& site) {
    return !hemisphere_->lost(site) && site.surface % 3 != 2;  // which only emits
  };
  std::vector<double> light(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!in_mesh(sites[i])) continue;
    for (const VertexId v : sites[i].vertices) light[i] += luminance(state_.sent[v]) / 3;
  }
  state_.around.resize(state_.light.size());
  parallel_for(state_.light.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Row<Link>& row = state_.light[v].row;
      state_.around[v] = {};
      if (!state_.light[v].gathers || row.empty()) continue;
      const auto mean = [&](const auto& value) {
        return mean_over(row, [&](std::size_t i) {
          const Site& site = sites[row.rays[i].site];
          return in_mesh(site) ? value(row.rays[i].site, site) : 0.0;
        });
      };
      const double met = mean([](std::uint32_t, const Site&) { return 1.0; });
      if (!(met > 0)) continue;
      const Vec3& from = mesh_.vertex(VertexId(v)).position;
      state_.around[v] = {
          mean([&](std::uint32_t number, const Site&) { return light[number]; }) / met,
          mean([&](std::uint32_t, const Site& site) {
            return distance(mesh_.vertex(site.vertices[0]).position, from);
          }) / met};
    }
  });
  for (const VertexId v : order()) {
    if (state_.light[v].gathers) continue;
    Surroundings sum;
    double weights = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = state_.light[v].among.weights[k];
      if (weight == 0) continue;
      const Surroundings& parent = state_.around[state_.light[v].among.vertices[k]];
      if (parent.distance == 0) continue;
      sum.irradiance += weight * parent.irradiance;
      sum.distance += weight * parent.distance;
      weights += weight;
    }
    if (weights > 0) state_.around[v] = {sum.irradiance / weights, sum.distance / weights};
  }
  double sum = 0, area = 0;
  for (const Triangle& triangle : mesh_.triangles()) {
    if (!triangle.alive) continue;
    for (const VertexId v : triangle.vertices) sum += room_importance(v) * triangle.area / 3;
    area += triangle.area;
  }
  state_.mean_importance = area > 0 ? sum / area : 1;
}

/// What surrounds a vertex, or one that it lies among; unknown before look_around().
const Surroundings* Gathering::around(VertexId v) const {
  if (state_.around.empty()) return nullptr;
  while (v >= state_.around.size()) v = state_.light[v].among.vertices[0];
  return &state_.around[v];
}

/// The irradiance that errors at a vertex count little against, lx: the mean over all surfaces;
/// under a sky, that of what is seen from there, where that is less.
double Gathering::usual_irradiance(VertexId v) const {
  constexpr double kDarkest = 0.001;  // of the mean
  const Surroundings* const seen = around(v);
  if (!seen || seen->irradiance == 0) return mean_irradiance();
  return std::clamp(seen->irradiance, kDarkest * mean_irradiance(), mean_irradiance());
}

/// The size of the room that a vertex stands in, m: that of the scene; under a sky, as far as it
/// sees, where that is less, but no less than a small room.
double Gathering::extent(VertexId v) const {
  constexpr double kAcross = 3;  // of the mean distance: a cube's diagonal is 2.6 times that
  constexpr double kSmallest = 1.0 / 30;  // of the diagonal
  const Surroundings* const seen = around(v);
  if (!seen || seen->distance == 0) return diagonal_;
  return std::clamp(kAcross * seen->distance, kSmallest * diagonal_, diagonal_);
}

/// How much an error at a vertex counts for its area. Over all surfaces the ground outside would be
/// all that counts; as if the room that each is in were as large as the scene, the ground that
/// lights it would not. So errors are to be small in both means: these are added.
double Gathering::importance(VertexId v) const {
  return state_.around.empty() ? 1 : 1 + room_importance(v) / state_.mean_importance;
}

/// What a triangle counts in the error over all surfaces, m².
double Gathering::weight(const Triangle& triangle) const {
  const auto& [a, b, c] = triangle.vertices;
  return triangle.area * ((importance(a) + importance(b) + importance(c)) / 3);
}

}  // namespace isolux
