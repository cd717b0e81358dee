#include "isolux/discretization/triangulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "isolux/core/error.h"

namespace isolux {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Rules kRules{.max_edge = 1, .min_area = 1e-4, .normal_tolerance = 0.5};
const Bounds kBounds{{-2, -2, -2}, {2, 2, 2}};

/// A point of the plane z = 0.
SurfacePoint flat(double x, double y) { return {{x, y, 0}, {0, 0, 1}, {0, 0}, gray(0.5)}; }

struct Mesh : Triangulation {
  Mesh() : Triangulation(kRules, kBounds) {}
  VertexId extend_at(double x, double y) { return extend(flat(x, y)).value(); }
};

TEST(Triangulation, ThreePointsWithinDeltaMakeATriangle) {
  Mesh mesh;
  mesh.extend_at(0, 0), mesh.extend_at(0.5, 0);
  EXPECT_EQ(mesh.triangle_count(), 0u);
  mesh.extend_at(0, 0.5);
  ASSERT_EQ(mesh.triangle_count(), 1u);
  EXPECT_NEAR(mesh.triangle(0).area, 0.125, 1e-15);
  EXPECT_EQ(mesh.triangle(0).normal, (Vec3{0, 0, 1}));
  EXPECT_THAT(mesh.validate(), IsEmpty());
}

TEST(Triangulation, EdgesAreNoLongerThanDelta) {
  Mesh mesh;
  const VertexId a = mesh.extend_at(0, 0), b = mesh.extend_at(0.999, 0),
                 c = mesh.extend_at(-0.1, 0);
  EXPECT_TRUE(mesh.has_edge(a, b));
  EXPECT_FALSE(mesh.has_edge(b, c));
}

TEST(Triangulation, NewEdgesCrossNoPossibleEdge) {
  Mesh mesh;
  // The edge ab stands between c and d.
  const VertexId a = mesh.extend_at(0, -0.4), b = mesh.extend_at(0, 0.4);
  const VertexId c = mesh.extend_at(-0.3, 0), d = mesh.extend_at(0.3, 0);
  EXPECT_TRUE(mesh.has_edge(a, b));
  EXPECT_FALSE(mesh.has_edge(c, d));
  EXPECT_EQ(mesh.triangle_count(), 2u);
  EXPECT_THAT(mesh.validate(), IsEmpty());
}

TEST(Triangulation, AnEdgeBarsItsWayFromSqrt5Over2DeltaAway) {
  // Its ends are just under δ from each other, and as far from the new vertex as they can be while
  // the edge still crosses one of length δ: in the corners of the figure behind §3.2.2.
  Mesh mesh;
  const double reach = 0.999;
  const VertexId w = mesh.extend_at(reach, 0);
  mesh.extend_at(reach - 0.01, -reach / 2), mesh.extend_at(reach - 0.01, reach / 2);
  const VertexId v = mesh.extend_at(0, 0);
  EXPECT_FALSE(mesh.has_edge(v, w));
}

TEST(Triangulation, AVertexCloserThanTheLeastSpacingIsRefused) {
  Mesh mesh;
  mesh.extend_at(0, 0);
  EXPECT_FALSE(mesh.extend(flat(0.9 * mesh.least_spacing(), 0)));
  EXPECT_TRUE(mesh.extend(flat(1.1 * mesh.least_spacing(), 0)));
  EXPECT_EQ(mesh.vertices().size(), 2u);
  // The other side of a thin plate is another place.
  EXPECT_TRUE(mesh.extend({{0, 0, -1e-6}, {0, 0, -1}, {0, 0}, gray(0.5)}));
}

TEST(Triangulation, NormalsBeyondTheToleranceShareNoTriangle) {
  Mesh mesh;
  mesh.extend_at(0, 0), mesh.extend_at(0.5, 0);
  const Vec3 tilted{0, std::sin(0.6), std::cos(0.6)};
  const VertexId v = mesh.extend({{0.2, 0.3, 0}, tilted, {0, 0}, gray(0.5)}).value();
  EXPECT_THAT(mesh.vertex(v).neighbours, IsEmpty());
  EXPECT_EQ(mesh.triangle_count(), 0u);
}

TEST(Triangulation, SplittingPutsThreeTrianglesInPlaceOfOne) {
  Mesh mesh;
  mesh.extend_at(0, 0), mesh.extend_at(0.6, 0), mesh.extend_at(0, 0.6);
  mesh.triangle(0).shot = gray(3);
  const VertexId v = mesh.split(0, flat(0.2, 0.2)).value();
  EXPECT_EQ(mesh.triangle_count(), 3u);
  EXPECT_FALSE(mesh.triangle(0).alive);
  double area = 0;
  for (TriangleId t : mesh.vertex(v).triangles) {
    area += mesh.triangle(t).area;
    EXPECT_EQ(mesh.triangle(t).shot, gray(3)) << "children inherit what was shot";
  }
  EXPECT_NEAR(area, 0.18, 1e-15);
  EXPECT_THAT(mesh.validate(), IsEmpty());
}

TEST(Triangulation, NoSplitMakesATriangleSmallerThanDeltaArea) {
  Mesh mesh;
  // Area 2.9 Δ: its thirds would be too small.
  const double side = std::sqrt(2 * 2.9 * kRules.min_area);
  mesh.extend_at(0, 0), mesh.extend_at(side, 0), mesh.extend_at(0, side);
  EXPECT_FALSE(mesh.split(0, flat(side / 3, side / 3)));
  EXPECT_EQ(mesh.triangle_count(), 1u);
}

TEST(Triangulation, APointOutsideTheTriangleDoesNotSplitIt) {
  Mesh mesh;
  mesh.extend_at(0, 0), mesh.extend_at(0.6, 0), mesh.extend_at(0, 0.6);
  EXPECT_FALSE(mesh.split(0, flat(0.5, 0.5)));
  EXPECT_FALSE(mesh.split(0, flat(0.3, 0.001))) << "too close to a side";
  EXPECT_THAT(mesh.validate(), IsEmpty());
}

TEST(Triangulation, RemovedTrianglesLeaveTheirEdges) {
  Mesh mesh;
  const VertexId a = mesh.extend_at(0, 0), b = mesh.extend_at(0.6, 0);
  mesh.extend_at(0, 0.6);
  mesh.remove(0);
  EXPECT_EQ(mesh.triangle_count(), 0u);
  EXPECT_TRUE(mesh.has_edge(a, b));
  EXPECT_THAT(mesh.vertex(a).triangles, IsEmpty());
  // A vertex born there later takes them up again.
  mesh.extend_at(0.2, 0.2);
  EXPECT_EQ(mesh.triangle_count(), 3u);
  EXPECT_THAT(mesh.validate(), IsEmpty());
}

TEST(Triangulation, ALightTakesNoOtherEdgesAndIsNeitherSplitNorRemoved) {
  Mesh mesh;
  const TriangleSoup soup{{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}}, {{0, 1, 2}}};
  mesh.add_light(soup, {0, 0}, gray(0), gray(100));
  const VertexId v = mesh.extend_at(-0.1, -0.1);
  EXPECT_THAT(mesh.vertex(v).neighbours, IsEmpty());
  mesh.remove(0);
  EXPECT_FALSE(mesh.split(0, flat(0.1, 0.1)));
  EXPECT_EQ(mesh.triangle_count(), 1u);
  EXPECT_EQ(mesh.triangle(0).emission, gray(100));
  EXPECT_THAT(mesh.validate(), IsEmpty());
}

TEST(Triangulation, ConnectableChangesNothingAndSaysWhatExtendDoes) {
  Mesh mesh;
  for (double x : {0.0, 0.3, 0.6}) {
    for (double y : {0.0, 0.35, 0.7}) mesh.extend_at(x + 0.1 * y, y - 0.07 * x);
  }
  const auto neighbours = mesh.connectable(flat(-0.15, 0.4));
  const std::size_t before = mesh.vertices().size();
  const VertexId v = mesh.extend_at(-0.15, 0.4);
  EXPECT_EQ(v, before);
  EXPECT_EQ(mesh.vertex(v).neighbours, neighbours);
}

TEST(Triangulation, APointThatATriangleCoversIsRefused) {
  Mesh mesh;
  mesh.extend_at(0, 0), mesh.extend_at(0.6, 0), mesh.extend_at(0, 0.6);
  EXPECT_FALSE(mesh.extend(flat(0.2, 0.2)));
  EXPECT_TRUE(mesh.extend(flat(0.4, 0.4)));
  EXPECT_THAT(mesh.validate(), IsEmpty());
}

TEST(Triangulation, UnusableRulesAreRefused) {
  for (const Rules& rules : {Rules{0, 1e-4, 0.5}, Rules{-1, 1e-4, 0.5}, Rules{1, 0, 0.5},
                             Rules{1, 1e-4, 0}, Rules{1, 1e-4, 3}, Rules{1e-12, 1e-4, 0.5}}) {
    EXPECT_THROW(Triangulation(rules, kBounds), InputError);
  }
}

TEST(Triangulation, RestoringARuinedMeshIsRefused) {
  Mesh mesh;
  mesh.extend_at(0, 0), mesh.extend_at(0.5, 0), mesh.extend_at(0, 0.5), mesh.extend_at(0.5, 0.5);
  EXPECT_THROW(mesh.restore_triangle({0, 1, 9}, {}, {}, false), InputError);
  EXPECT_THROW(mesh.restore_triangle({0, 1, 1}, {}, {}, false), InputError);
  while (mesh.triangle_count() < 3) {
    try {
      mesh.restore_triangle({0, 1, 2}, {}, {}, false);
    } catch (const InputError&) {
      return;  // the third triangle on one edge
    }
  }
  FAIL() << "an edge took three triangles";
}

}  // namespace
}  // namespace isolux
