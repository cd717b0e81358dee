#include "geometry/turned_nurbs.h"
#include "geometry/zoo.h"
#include "isolux/geometry/bezier.h"

namespace isolux {
namespace {

/// Patches over 3 × 3 m of the plane z = 1, side by side along x: their control points lie evenly
/// over it, so that they are the graph of a bicubic function.
void add_bezier(std::vector<Specimen>& zoo) {
  const std::vector<std::vector<double>> heights = {
      {0, 0, 0, 1, 0, 2, 0, 1, 0, -1, 3, 1, 0, 0, 0, 0},
      {1, 2, 0, 0, 1, 2, 2, 0, 1, 2, -2, 1, 0, 0, 1, 1}};
  std::vector<Bezier::Points> patches(2);
  std::vector<Bicubic> graphs;
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < 16; ++i) {
      const double x = static_cast<double>(3 * k + i % 4), y = static_cast<double>(i / 4);
      patches[k].push_back({x, y, 1 + heights[k][i]});
    }
    Bicubic& graph = graphs.emplace_back();
    std::copy(heights[k].begin(), heights[k].end(), graph.c.begin());
  }
  const Level level = [graphs](const Vec3& p) {
    const std::size_t k = p.x < 3 ? 0 : 1;
    const auto f =
        graphs[k].slopes_at(CubicBasis(p.x / 3 - static_cast<double>(k)), CubicBasis(p.y / 3));
    return (p.z - 1 - f.value) / length({f.along_u / 3, f.along_v / 3, 1});
  };
  zoo.push_back({"BezierPatch",
                 std::make_shared<Bezier>(std::vector<Bezier::Points>{patches[0]}),
                 level,
                 {{0, 0, 1}, {3, 0, 2}, {3, 3, 1}, {0, 3, 1}}});
  zoo.push_back({"BezierPatches",
                 std::make_shared<Bezier>(patches),
                 level,
                 {{0, 0, 1}, {3, 0, 2}, {6, 3, 2}}});
}

/// Surfaces turned about an axis that is shifted and tilted.
void add_nurbs(std::vector<Specimen>& zoo) {
  Affine map = Affine::rotate({1, 2, 3}, 0.7);
  map.translation = {1, -1, 0.5};
  const auto add = [&](const std::string& name, const RationalCurve& curve, Level level) {
    const Level there = [level, inverse = *map.inverse()](const Vec3& p) {
      return level(inverse.point(p));
    };
    zoo.push_back({name, turned(curve, map), there, {map.point(curve.points.front().place)}});
  };
  add("NurbsSphere", arc(0, 1.5, -2, 2), [](const Vec3& p) { return length(p) - 1.5; });
  add("NurbsTorus", arc(2, 0.7, -4, 4),
      [](const Vec3& p) { return std::hypot(std::hypot(p.x, p.y) - 2, p.z) - 0.7; });
  add("NurbsCone", line({1, 0, -1}, {0, 0, 1}),
      [](const Vec3& p) { return (2 * std::hypot(p.x, p.y) + p.z - 1) / std::sqrt(5.0); });
}

}  // namespace

void add_patches(std::vector<Specimen>& zoo) {
  add_bezier(zoo);
  add_nurbs(zoo);
}

}  // namespace isolux
