// Rays to curved surfaces: spheres of Bézier patches and as NURBS and a bent patch, beside a true
// sphere. Items are rays.

#include <benchmark/benchmark.h>

#include <cmath>

#include "geometry/turned_nurbs.h"
#include "isolux/core/random.h"
#include "isolux/geometry/bezier.h"
#include "isolux/geometry/sphere.h"
#include "isolux/raycast/ray_caster.h"
#include "isolux/sampling/lines.h"

namespace isolux {
namespace {

using ShapePtr = std::shared_ptr<const Shape>;

/// Eight patches, of a unit sphere within 0.06 %, whose poles are edges shrunk to a point.
ShapePtr globe() {
  const double k = 4.0 / 3 * (std::sqrt(2.0) - 1);
  const double radius[4] = {1, 1, k, 0}, height[4] = {0, k, 1, 1};
  std::vector<Bezier::Points> patches;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double c = std::array{1, 0, -1, 0}[quarter], s = std::array{0, 1, 0, -1}[quarter];
    const Vec3 round[4] = {
        {c, s, 0}, {c - k * s, s + k * c, 0}, {k * c - s, k * s + c, 0}, {-s, c, 0}};
    Bezier::Points upper, lower;
    for (std::size_t j = 0; j < 4; ++j) {
      for (const Vec3& p : round) {
        upper.push_back(p * radius[j] + Vec3{0, 0, height[j]});
        lower.push_back(p * radius[3 - j] - Vec3{0, 0, height[3 - j]});
      }
    }
    patches.push_back(upper), patches.push_back(lower);
  }
  return std::make_shared<Bezier>(patches);
}

/// One patch as a sail in the wind.
ShapePtr sail() {
  const double heights[16] = {0, 0, 0, 1, 0, 1.3, 0.7, 0, 0, 1.7, -0.7, 0.7, 0, 0, 0, 0};
  Bezier::Points points;
  for (int i = 0; i < 16; ++i)
    points.push_back({(i % 4 - 1.5) / 1.5, (i / 4 - 1.5) / 1.5, 0.5 * heights[i]});
  return std::make_shared<Bezier>(std::vector<Bezier::Points>{points});
}

/// Segments of half the lines that meet the unit ball.
std::vector<Segment> segments() {
  Random random(1);
  std::vector<Segment> all;
  while (all.size() < 4096) {
    const Line line = random_line({}, 1.2, random);
    all.push_back({line.point - line.direction * 2, line.point + line.direction * 2});
  }
  return all;
}

Scene scene_of(ShapePtr shape) {
  Scene scene;
  scene.objects.emplace_back().shape = std::move(shape);
  return scene;
}

void nearest(benchmark::State& state, ShapePtr (*make)()) {
  const Scene scene = scene_of(make());
  const RayCaster rays(scene);
  const auto all = segments();
  for (auto _ : state) {
    for (const Segment& s : all)
      benchmark::DoNotOptimize(rays.nearest({s.from, s.to - s.from}, {0, 1}));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

void occluded(benchmark::State& state, ShapePtr (*make)()) {
  const Scene scene = scene_of(make());
  const RayCaster rays(scene);
  const auto all = segments();
  std::vector<std::uint8_t> blocked(all.size());
  for (auto _ : state) rays.occluded(all, blocked);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

void whole(benchmark::State& state, ShapePtr (*make)()) {
  const ShapePtr shape = make();
  const auto all = segments();
  Hits hits;
  for (auto _ : state) {
    for (const Segment& s : all) {
      hits.clear();
      shape->intersect({s.from, s.to - s.from}, hits);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(all.size()));
}

ShapePtr nurbs_sphere() { return turned(arc(0, 1, -2, 2)); }

ShapePtr sphere() { return std::make_shared<Sphere>(Vec3{}, 1); }

BENCHMARK_CAPTURE(nearest, sphere, sphere);
BENCHMARK_CAPTURE(nearest, globe, globe);
BENCHMARK_CAPTURE(nearest, nurbs_sphere, nurbs_sphere);
BENCHMARK_CAPTURE(nearest, sail, sail);
BENCHMARK_CAPTURE(occluded, sphere, sphere);
BENCHMARK_CAPTURE(occluded, globe, globe);
BENCHMARK_CAPTURE(occluded, nurbs_sphere, nurbs_sphere);
BENCHMARK_CAPTURE(occluded, sail, sail);
BENCHMARK_CAPTURE(whole, globe, globe);
BENCHMARK_CAPTURE(whole, nurbs_sphere, nurbs_sphere);
BENCHMARK_CAPTURE(whole, sail, sail);

}  // namespace
}  // namespace isolux
