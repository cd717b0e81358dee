#include "isolux/raycast/ray_caster.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "isolux/core/random.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/triangle_mesh.h"
#include "support/scenes.h"

namespace isolux {
namespace {

Vec3 random_point(Random& random) { return {random.uniform(), random.uniform(), random.uniform()}; }

const char* kMixedScene = R"(
materials: {m: {reflectance: 0.5}}
objects:
  - {shape: {sphere: {center: [0.3, 0.3, 0.3], radius: 0.2}}, material: m}
  - {shape: {torus: {center: [0.7, 0.7, 0.5], axis: [1, 1, 1], major_radius: 0.2, minor_radius: 0.05}}, material: m}
  - {shape: {difference: [{box: {lower: [0.5, 0, 0], upper: [1, 0.4, 0.4]}}, {sphere: {center: [0.75, 0.2, 0.4], radius: 0.15}}]}, material: m}
  - {shape: {mesh: {points: [[0, 0.6, 0], [0.4, 0.6, 0], [0, 1, 0], [0.1, 0.7, 0.5]], triangles: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]}}, material: m}
  - {shape: {parallelogram: {corner: [0, 0, 0.9], u: [1, 0, 0], v: [0, 1, 0]}}, material: m}
)";

/// What every query must agree with: each shape asked by itself.
std::vector<double> brute_force(const Scene& scene, const Ray& ray, Interval within) {
  Hits hits;
  for (const Object& object : scene.objects) object.shape->intersect(ray, hits);
  std::vector<double> ts;
  for (const Hit& hit : hits) {
    if (hit.t > within.min && hit.t < within.max) ts.push_back(hit.t);
  }
  std::sort(ts.begin(), ts.end());
  return ts;
}

void expect_packets_meet_what_single_rays_meet(const RayCaster& rays,
                                               std::span<const Segment> segments) {
  std::vector<Ray> all;
  for (const Segment& s : segments) all.push_back({s.from, s.to - s.from});
  std::vector<std::optional<SurfaceHit>> hits(all.size());
  rays.nearest(all, hits);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto alone = rays.nearest(all[i]);
    ASSERT_EQ(hits[i].has_value(), alone.has_value()) << "ray " << i;
    if (!alone) continue;
    EXPECT_EQ(hits[i]->t, alone->t);
    EXPECT_EQ(hits[i]->surface, alone->surface);
    EXPECT_EQ(hits[i]->normal, alone->normal);
    EXPECT_EQ(hits[i]->back, alone->back);
  }
}

TEST(RayCaster, AllQueriesAgreeWithTheShapesThemselves) {
  Scene scene = scene_of(kMixedScene);
  for (Object& object : scene.objects) object.sides = Sides::front;
  const RayCaster rays(scene);
  Random random(7);
  std::vector<SurfaceHit> hits;
  std::vector<Segment> segments;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 from = random_point(random), to = random_point(random);
    const Ray ray{from, to - from};
    segments.push_back({from, to});
    const std::vector<double> expected = brute_force(scene, ray, {});
    rays.all_hits(ray, {}, hits);
    ASSERT_EQ(hits.size(), expected.size()) << "ray " << i;
    for (std::size_t k = 0; k < hits.size(); ++k) {
      EXPECT_EQ(hits[k].t, expected[k]);
      EXPECT_NEAR(distance(hits[k].point, ray.at(hits[k].t)), 0, 1e-12);
    }
    const auto first = rays.nearest(ray);
    ASSERT_EQ(first.has_value(), !expected.empty());
    if (first) {
      EXPECT_EQ(first->t, expected[0]);
    }
    const bool blocked = !brute_force(scene, ray, {0, 1 - 1e-6}).empty();
    EXPECT_EQ(rays.occluded(Segment{from, to}), blocked) << "ray " << i;
  }
  std::vector<std::uint8_t> blocked(segments.size());
  rays.occluded(segments, blocked);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    EXPECT_EQ(blocked[i] != 0, rays.occluded(segments[i])) << "segment " << i;
  }
  expect_packets_meet_what_single_rays_meet(rays, segments);
  const Scene open = scene_of(kMixedScene);
  expect_packets_meet_what_single_rays_meet(RayCaster(open), segments);
}

TEST(RayCaster, TheIntervalIsOpenAtBothEnds) {
  const Scene scene = scene_of(R"(
materials: {m: {reflectance: 0.5}}
objects: [{shape: {box: {lower: [1, -1, -1], upper: [2, 1, 1]}}, material: m}]
)");
  const RayCaster rays(scene);
  const Ray ray{{0, 0, 0}, {1, 0, 0}};
  std::vector<SurfaceHit> hits;
  rays.all_hits(ray, {1, 2}, hits);
  EXPECT_TRUE(hits.empty());
  rays.all_hits(ray, {0.999, 2.001}, hits);
  EXPECT_EQ(hits.size(), 2u);
  EXPECT_FALSE(rays.nearest(ray, {0, 1}));
  EXPECT_EQ(rays.nearest(ray, {1, 3})->t, 2);
  EXPECT_FALSE(rays.occluded(Segment{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_TRUE(rays.occluded(Segment{{0, 0, 0}, {1.001, 0, 0}}));
}

TEST(RayCaster, AnOpenSurfaceHasTwoSidesUnlessToldOtherwise) {
  Scene scene = scene_of(R"(
materials: {m: {reflectance: 0.5}}
objects: [{shape: {parallelogram: {corner: [-1, -1, 1], u: [2, 0, 0], v: [0, 2, 0]}}, material: m}]
)");
  std::vector<SurfaceHit> hits;
  const Ray up{{0, 0, 0}, {0, 0, 1}};
  {
    const RayCaster rays(scene);
    rays.all_hits(up, {}, hits);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_EQ(hits[0].normal, (Vec3{0, 0, -1}));
    EXPECT_TRUE(hits[0].back);
    EXPECT_EQ(hits[1].normal, (Vec3{0, 0, 1}));
    EXPECT_EQ(rays.nearest(up)->normal, (Vec3{0, 0, -1}));
  }
  scene.objects[0].sides = Sides::front;
  const RayCaster rays(scene);
  rays.all_hits(up, {}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].normal, (Vec3{0, 0, 1}));
}

TEST(RayCaster, ALightHidesWhatItIsGluedTo) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  std::vector<SurfaceHit> hits;
  const Ray up{{0.48, 0.51, 0.9}, {0, 0, 1}};
  rays.all_hits(up, {}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_TRUE(scene.objects[hits[0].surface.object].emits());
  EXPECT_TRUE(scene.objects[rays.nearest(up)->surface.object].emits());
  // Beside it there is only the ceiling.
  EXPECT_FALSE(scene.objects[rays.nearest({{0.3, 0.5, 0.9}, {0, 0, 1}})->surface.object].emits());
}

TEST(RayCaster, OfTwoSurfacesGluedTogetherTheLaterInTheSceneIsThere) {
  const Scene scene = scene_of(R"(
materials: {floor: {reflectance: 0.5}, rug: {reflectance: 0}}
objects:
  - {shape: {box: {lower: [0, 0, 0], upper: [1, 1, 1], inward: true}}, material: floor}
  - {shape: {parallelogram: {corner: [0.2, 0.2, 0], u: [0.6, 0, 0], v: [0, 0.6, 0]}}, material: rug, sides: front}
)");
  const RayCaster rays(scene);
  Random random(3);
  std::vector<SurfaceHit> hits;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from{random.uniform(), random.uniform(), 0.9};
    const Vec3 to{0.2 + 0.6 * random.uniform(), 0.2 + 0.6 * random.uniform(), 0};
    const Ray ray{from, to - from};
    EXPECT_EQ(rays.nearest(ray)->surface.object, 1u);
    rays.all_hits(ray, {}, hits);
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_EQ(hits[0].surface.object, 1u);
  }
}

TEST(RayCaster, TwoSurfacesGluedBackToBackAreBothThere) {
  const Scene scene = scene_of(R"(
materials: {m: {reflectance: 0.5}}
objects:
  - {shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}}, material: m, sides: front}
  - {shape: {parallelogram: {corner: [0, 0, 0], u: [0, 1, 0], v: [1, 0, 0]}}, material: m, sides: front}
)");
  const RayCaster rays(scene);
  std::vector<SurfaceHit> hits;
  for (const double from : {1.0, -1.0}) {
    const Ray ray{{0.4, 0.3, from}, {0.1, 0.1, -from}};
    EXPECT_EQ(rays.nearest(ray)->surface.object, from > 0 ? 0u : 1u) << "the one that looks here";
    rays.all_hits(ray, {}, hits);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_EQ(hits[0].normal, -hits[1].normal);
  }
}

TEST(RayCaster, SurfacesInsideOtherSolidsAreBuried) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  EXPECT_TRUE(rays.buried({0.5, 0.52, 0}, {0, 0, 1})) << "the floor under the pedestal";
  EXPECT_TRUE(rays.buried({0.5, 0.52, 0}, {0, 0, -1})) << "the pedestal's foot";
  EXPECT_FALSE(rays.buried({0.5, 0.6, 0}, {0, 0, 1})) << "the open floor";
  EXPECT_FALSE(rays.buried({0.55, 0.5, 0.2}, {1, 0, 0})) << "the pedestal's side";
}

TEST(RayCaster, HitsAreExactFarFromTheOrigin) {
  Scene scene = scene_of(R"(
materials: {m: {reflectance: 0.5}}
objects: [{shape: {sphere: {center: [100000, 0, 0], radius: 1}}, material: m}]
)");
  const RayCaster rays(scene);
  for (double offset : {0.0, 0.5, 0.9, 0.99999}) {
    const auto hit = rays.nearest({{0, offset, 0}, {1, 0, 0}});
    ASSERT_TRUE(hit) << offset;
    EXPECT_NEAR(distance(hit->point, {100000, 0, 0}), 1, 1e-9) << offset;
  }
}

/// Holds what may stand between random boxes of the unit cube against all that is there.
void expect_blockers_stop_what_all_stop(const Scene& scene) {
  const RayCaster rays(scene);
  Random random(8);
  std::ptrdiff_t none = 0, blocked_count = 0;
  for (int i = 0; i < 1000; ++i) {
    Bounds from, to;
    for (Bounds* box : {&from, &to}) {
      const Vec3 corner = random_point(random) * 0.9;
      box->include(corner), box->include(corner + random_point(random) * 0.1);
    }
    std::array<Segment, 37> segments;
    for (Segment& s : segments) {
      const Vec3 a = random_point(random), b = random_point(random);
      const Vec3 f = from.upper - from.lower, t = to.upper - to.lower;
      s = {from.lower + Vec3{a.x * f.x, a.y * f.y, a.z * f.z},
           to.lower + Vec3{b.x * t.x, b.y * t.y, b.z * t.z}};
    }
    std::array<std::uint8_t, 37> among, all;
    const Blockers blockers = rays.blockers(from, to);
    rays.occluded(blockers, segments, among);
    rays.occluded(segments, all);
    EXPECT_EQ(among, all);
    none += blockers.none();
    blocked_count += std::count(all.begin(), all.end(), 1);
  }
  EXPECT_GT(none, 100);
  EXPECT_GT(blocked_count, 1000);
}

TEST(RayCaster, TheBlockersOfTwoBoxesStopTheSameSegmentsAsAll) {
  expect_blockers_stop_what_all_stop(paper_room());
}

TEST(RayCaster, TheBlockersAmongVeryManyObjects) {
  std::string yaml = "materials: {m: {reflectance: 0.5}}\nobjects:\n";
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random_point(random);
    yaml += fmt::format(
        "  - {{shape: {{sphere: {{center: [{}, {}, {}], radius: 0.015}}}}, material: m}}\n", p.x,
        p.y, p.z);
  }
  expect_blockers_stop_what_all_stop(scene_of(yaml));
}

/// An open sheet of n² cells over the unit square.
std::shared_ptr<const Shape> sheet(std::uint32_t n) {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t k = 0; k <= n; ++k) {
      const double x = double(i) / n, y = double(k) / n;
      points.push_back({x, y, x * (1 - x) + 0.3 * std::sin(9 * y)});
      const std::uint32_t a = i * (n + 1) + k;
      if (i == n || k == n) continue;
      triangles.push_back({a, a + n + 1, a + n + 2});
      triangles.push_back({a, a + n + 2, a + 1});
    }
  }
  return std::make_shared<TriangleMesh>(points, triangles);
}

// Moved far, turned, stretched, mirrored and tiny: what one tree for all of them finds is what each
// finds by itself.
TEST(RayCaster, SharedShapesAreMetWhereTheyStand) {
  const auto mesh = sheet(12);
  Scene scene;
  scene.materials = {{"m", gray(0.5)}};
  const std::vector<Affine> maps{
      {},
      Affine::translate({500, -300, 20}),
      Affine::translate({2, 0, 0}) * Affine::rotate({1, 2, 3}, 0.7) * Affine::scale({3, 0.5, -2}),
      Affine::translate({0, 0, 1}) * Affine::scale({1e-3, 1e-3, 1e-3}),
      Affine::translate({0, 5, 0}) * Affine::scale({1e3, 1e-3, 1}),  // too much for one tree
  };
  for (const Affine& map : maps) {
    scene.objects.push_back({"sheet", std::make_shared<Instance>(mesh, map), 0, Sides::front, {}});
  }
  const RayCaster rays(scene);
  Random random(11);
  std::vector<SurfaceHit> hits;
  std::vector<Segment> segments;
  std::size_t met = 0;
  for (int i = 0; i < 20000; ++i) {
    const Affine& map = maps[static_cast<std::size_t>(i) % maps.size()];
    const Vec3 to = map.point(random_point(random));
    const Vec3 from = map.point(random_point(random) * 3 - Vec3{1, 1, 1});
    const Ray ray{from, to - from};
    segments.push_back({from, to});
    const std::vector<double> expected = brute_force(scene, ray, {});
    rays.all_hits(ray, {}, hits);
    ASSERT_EQ(hits.size(), expected.size()) << "ray " << i;
    for (std::size_t k = 0; k < hits.size(); ++k) EXPECT_EQ(hits[k].t, expected[k]);
    met += hits.size();
    const bool blocked = !brute_force(scene, ray, {0, 1 - 1e-6}).empty();
    EXPECT_EQ(rays.occluded(Segment{from, to}), blocked) << "ray " << i;
  }
  EXPECT_GT(met, 5000u);
  expect_packets_meet_what_single_rays_meet(rays, segments);
}

}  // namespace
}  // namespace isolux
