#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "covered.h"
#include "isolux/core/parallel.h"
#include "isolux/core/random.h"
#include "isolux/discretization/coverage.h"
#include "isolux/discretization/point_spacing.h"
#include "isolux/discretization/split_points.h"
#include "support/scenes.h"

namespace isolux {
namespace {

constexpr double kPi = 3.14159265358979323846;

struct Case {
  std::string name;
  std::string objects;
  double spacing;
  double area;   // m² that light can reach, of the true surfaces
  double slack;  // of the mesh's area: facets of curved surfaces lie inside them
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

const Case kCases[] = {
    {"two_sided_sheet",
     "[{shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0.3, 1, 0]}}, material: m}]",
     0.1, 2, 0.005},
    {"torus",
     "[{shape: {torus: {center: [0, 0, 0], axis: z, major_radius: 1, minor_radius: 0.4}}, "
     "material: m}]",
     0.2, 4 * kPi* kPi * 0.4, 0.03},
    {"box_on_floor",
     "[{shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}}, material: m, "
     "sides: front}, {shape: {box: {lower: [0.3, 0.35, 0], upper: [0.6, 0.5, 0.4]}}, material: m}]",
     0.1, 1 + 2 * 0.4 * 0.45 + 0.3 * 0.15, 0.005},
    {"thin_plates",
     "[{shape: {box: {lower: [0, 0, 0], upper: [1, 1, 1], inward: true}}, material: m}, "
     "{shape: {box: {lower: [0.2, 0.3, 0.5], upper: [0.8, 0.7, 0.502]}}, material: m}, "
     "{shape: {box: {lower: [0.2, 0.5, 0], upper: [0.8, 0.503, 0.3]}}, material: m}]",
     0.1, 6 - 0.6 * 0.003 + 2 * (0.24 + 1.0 * 0.002) + (2 * 0.3 * 0.603 + 0.6 * 0.003), 0.005},
    {"mesh_tent",
     "[{shape: {mesh: {points: [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0.8]], "
     "triangles: [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]}}, material: m, sides: front}]",
     0.1, 2 * std::sqrt(0.25 + 0.64), 0.005},
    {"room", "", 0.1, 6 + kPi * 0.1 * 0.3 + kPi * 0.01, 0.005},
};

Scene scene_for(const Case& c) {
  return c.objects.empty() ? paper_room()
                           : scene_of("materials: {m: {reflectance: 0.5}}\nobjects: " + c.objects);
}

double area_of(const Triangulation& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles()) area += t.alive ? t.area : 0;
  return area;
}

/// The part of the triangles with an angle under 15 degrees.
double thin_part(const Triangulation& mesh) {
  int thin = 0;
  for (const Triangle& t : mesh.triangles()) {
    double least = kPi;
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = mesh.vertex(t.vertices[k]).position;
      const Vec3 a = mesh.vertex(t.vertices[(k + 1) % 3]).position - p;
      const Vec3 b = mesh.vertex(t.vertices[(k + 2) % 3]).position - p;
      least = std::min(least, std::atan2(length(cross(a, b)), dot(a, b)));
    }
    thin += t.alive && least < kPi / 12;
  }
  return static_cast<double>(thin) / static_cast<double>(mesh.triangle_count());
}

class Cover : public testing::TestWithParam<Case> {};

TEST_P(Cover, LeavesNoSurfaceOutAndNoneTwice) {
  const Scene scene = scene_for(GetParam());
  const RayCaster rays(scene);
  const Triangulation mesh = covered(rays, GetParam().spacing);
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  EXPECT_NEAR(area_of(mesh), GetParam().area, GetParam().slack * GetParam().area);
  const Coverage coverage = coverage_of(mesh, rays, 100'000, 7);
  EXPECT_GT(coverage.covered, 0.995 * coverage.area);
  EXPECT_NEAR(coverage.area, GetParam().area, 0.02 * GetParam().area);
  EXPECT_LT(thin_part(mesh), 0.05);
}

/// A tube a hundred times as long as it is thick takes triangles as long as the spacing allows.
TEST(CoverOfThinTubes, IsLongAlongThem) {
  const double radius = 0.005, length = 1;
  const Scene scene = scene_of(
      "materials: {m: {reflectance: 0.5}}\nobjects: [{shape: {cylinder: {from: [0, 0, 0], to: "
      "[0.6, 0, 0.8], radius: 0.005, open: true}}, material: m, sides: front}]");
  const RayCaster rays(scene);
  Triangulation mesh({0.8, 1e-9, 0.77}, rays.scene().bounds());
  cover(mesh, rays, {0.4, 1});
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  EXPECT_NEAR(area_of(mesh), 2 * kPi * radius * length, 0.05 * 2 * kPi * radius * length);
  const Coverage coverage = coverage_of(mesh, rays, 100'000, 7);
  EXPECT_GT(coverage.covered, 0.99 * coverage.area);
  EXPECT_LT(mesh.triangle_count(), 600u);
}

TEST(PointSpacing, MeasuresAsWhereItIsSqueezedAlongTheRuling) {
  const PointSpacing spacing{0.1, {0, 0, 1}, 8};
  EXPECT_DOUBLE_EQ(spacing.longest(), 0.8);
  EXPECT_NEAR(spacing.measure({0.1, 0, 0}), 0.1, 1e-15);
  EXPECT_NEAR(spacing.measure({0, 0, 0.8}), 0.1, 1e-15);
  EXPECT_NEAR(spacing.along({0, 0, 1}), 0.8, 1e-15);
  EXPECT_NEAR(distance(spacing.squeezed(spacing.stretched({3, 4, 5})), {3, 4, 5}), 0, 1e-14);
}

TEST_P(Cover, IsTheSameOnAnyNumberOfThreads) {
  const Scene scene = scene_for(GetParam());
  const RayCaster rays(scene);
  const auto positions = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<double> all;
    const Triangulation mesh = covered(rays, GetParam().spacing);
    for (const Vertex& v : mesh.vertices()) {
      all.insert(all.end(), {v.position.x, v.position.y, v.position.z});
    }
    for (const Triangle& t : mesh.triangles()) {
      for (const VertexId v : t.vertices) all.push_back(v);
    }
    return all;
  };
  EXPECT_EQ(positions(1), positions(2));
}

/// Edges are split at random, at creases too: the mesh stays valid, as large as it was, and thin
/// triangles few.
TEST_P(Cover, StaysWholeWhereEdgesAreSplit) {
  const Scene scene = scene_for(GetParam());
  const RayCaster rays(scene);
  Triangulation mesh = covered(rays, GetParam().spacing);
  const double before = area_of(mesh);
  Random random(5);
  int split = 0;
  for (int i = 0; i < 1000; ++i) {
    const Triangle& t =
        mesh.triangle(static_cast<TriangleId>(random.below(mesh.triangles().size())));
    if (!t.alive) continue;
    // The longest side, as a refinement would.
    VertexId a = 0, b = 0;
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      const VertexId p = t.vertices[k], q = t.vertices[(k + 1) % 3];
      const double along = distance(mesh.vertex(p).position, mesh.vertex(q).position);
      if (along > longest) longest = along, a = p, b = q;
    }
    const auto point = point_over_edge(mesh, rays, a, b);
    if (point && mesh.split_edge(a, b, *point)) ++split;
    if (i % 100 == 0) {
      ASSERT_THAT(mesh.validate(), testing::IsEmpty());
    }
  }
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  EXPECT_GT(split, 300);
  EXPECT_NEAR(area_of(mesh), before, 0.01 * before);
  EXPECT_LT(thin_part(mesh), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Zoo, Cover, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

TEST(CoverTest, CarvedDieRingAndTumbler) {
  const Scene scene = load_scene(source_dir() / "examples/csg/die.yaml");
  const RayCaster rays(scene);
  const Triangulation mesh = covered(rays, 0.05);
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  const Coverage coverage = coverage_of(mesh, rays, 100'000, 7);
  EXPECT_GT(coverage.covered, 0.995 * coverage.area);
  EXPECT_LT(thin_part(mesh), 0.05);
}

// Four strips that turn by 32 degrees at each fold: less than a triangle may span, more than the
// distance of points on round surfaces allows for.
TEST(CoverTest, BluntEdgesAskForFinerPointsWithinReason) {
  std::string points, triangles;
  Vec3 p{0, 0, 0};
  for (int i = 0; i <= 4; ++i) {
    points += fmt::format("[{0}, 0, {1}], [{0}, 1, {1}], ", p.x, p.z);
    const double angle = 0.56 * (i - 1.5);
    p += Vec3{std::cos(angle), 0, -std::sin(angle)} * 0.4;
    if (i < 4) {
      triangles += fmt::format("[{}, {}, {}], [{}, {}, {}], ", 2 * i, 2 * i + 2, 2 * i + 1,
                               2 * i + 1, 2 * i + 2, 2 * i + 3);
    }
  }
  const Scene scene = scene_of(
      fmt::format("materials: {{m: {{reflectance: 0.5}}}}\nobjects: [{{shape: {{mesh: {{points: "
                  "[{}], triangles: [{}]}}}}, material: m, sides: front}}]",
                  points, triangles));
  const RayCaster rays(scene);
  const Triangulation mesh = covered(rays, 0.1);
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  const Coverage coverage = coverage_of(mesh, rays, 100'000, 7);
  EXPECT_GT(coverage.covered, 0.995 * coverage.area);
  EXPECT_LT(mesh.vertices().size(), 5000u) << "a tenth of a metre apart, finer along the folds";
}

TEST(CoverTest, FacetedConesHaveAnEndOfPointsAtTheirTips) {
  constexpr int kFacets = 24;
  std::string points, triangles;
  for (int k = 0; k < kFacets; ++k) {
    const double angle = 2 * kPi * k / kFacets;
    points += fmt::format("[{}, {}, 0], ", 0.2 * std::cos(angle), 0.2 * std::sin(angle));
    const int next = (k + 1) % kFacets;
    triangles +=
        fmt::format("[{}, {}, {}], [{}, {}, {}], ", k, next, kFacets, next, k, kFacets + 1);
  }
  std::string text =
      "materials: {m: {reflectance: 0.5}}\nobjects:\n  - {shape: {box: {lower: [-2, -2, 0], "
      "upper: [2, 2, 2.5], inward: true}}, material: m}\n";
  for (int k = 0; k < 9; ++k) {
    text += fmt::format(
        "  - {{shape: {{mesh: {{points: [{}[0, 0, 0.7], [0, 0, 0]], triangles: [{}]}}}}, "
        "material: m, transform: [{{translate: [{}, {}, 0.1]}}]}}\n",
        points, triangles, 1.1 * (k % 3 - 1), 1.1 * (k / 3 - 1));
  }
  const Scene scene = scene_of(text);
  const RayCaster rays(scene);
  const Triangulation mesh = covered(rays, 0.364);
  EXPECT_LT(mesh.vertices().size(), 20'000u);
  const Coverage coverage = coverage_of(mesh, rays, 4000, 1);
  EXPECT_GT(coverage.covered, 0.99 * coverage.area);
}

TEST(CoverTest, LightsEmitAndOthersDoNot) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  const Triangulation mesh = covered(rays, 0.1);
  double emitting = 0;
  for (const Triangle& t : mesh.triangles()) {
    EXPECT_FALSE(t.on_light);
    if (t.alive && max_channel(t.emission) > 0) emitting += t.area;
  }
  EXPECT_NEAR(emitting, 0.01, 1e-4);
}

TEST(FlipTest, KeepsThePowerSent) {
  Triangulation mesh({1, 1e-9, 0.5}, {{-1, -1, -1}, {1, 1, 1}});
  const auto vertex = [&](double x, double y) {
    Vertex v;
    v.position = v.gather_point = {x, y, 0};
    v.normal = {0, 0, 1};
    return mesh.restore_vertex(v);
  };
  const VertexId a = vertex(0, -0.4), b = vertex(0, 0.4), c = vertex(-0.1, 0), d = vertex(0.2, 0);
  mesh.restore_triangle({a, b, c}, {}, gray(3), false);
  mesh.restore_triangle({b, a, d}, {}, gray(1), false);
  EXPECT_TRUE(mesh.flip(a, b));
  EXPECT_THAT(mesh.validate(), testing::IsEmpty());
  EXPECT_FALSE(mesh.has_edge(a, b));
  EXPECT_TRUE(mesh.has_triangle(c, d));
  double power = 0;
  for (const Triangle& t : mesh.triangles()) power += t.alive ? t.area * t.shot.r : 0;
  EXPECT_NEAR(power, 0.04 * 3 + 0.08 * 1, 1e-12);
  EXPECT_FALSE(mesh.flip(c, d));
}

TEST(CoverTest, StopsWhenToldWithAValidPart) {
  const Scene scene = paper_room();
  const RayCaster rays(scene);
  const auto points_of = [&](int looks) {
    Triangulation mesh({0.022, 1e-9, 0.77}, scene.bounds());
    CoverOptions options{0.01, 1, {}};
    options.keep_going = [&] { return looks-- > 0; };
    cover(mesh, rays, options);
    EXPECT_THAT(mesh.validate(), ::testing::IsEmpty());
    return mesh.vertices().size();
  };
  const std::size_t early = points_of(0), later = points_of(30);
  EXPECT_GT(early, 4000u);
  EXPECT_GT(later, early + 2000);
  EXPECT_LT(later, 40'000u);
}

}  // namespace
}  // namespace isolux
