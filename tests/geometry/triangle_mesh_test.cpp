#include "isolux/geometry/triangle_mesh.h"

#include <gtest/gtest.h>

#include "geometry/zoo.h"
#include "isolux/core/error.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/tessellation.h"
#include "isolux/geometry/torus.h"

namespace isolux {
namespace {

TriangleMesh mesh_of(const TriangleSoup& soup) { return {soup.points, soup.triangles}; }

/// A ray meets corners, edges and their continuations, where a naive test counts twice or never.
void expect_watertight(const TriangleMesh& mesh, const TriangleSoup& soup) {
  Random random(4);
  const Vec3 center = mesh.bounds().center();
  for (int i = 0; i < 4000; ++i) {
    const auto& t = soup.triangles[random.below(soup.triangles.size())];
    const Vec3 &a = soup.points[t[0]], &b = soup.points[t[1]];
    const Vec3 target = i % 3 == 0   ? a
                        : i % 3 == 1 ? (a + b) * 0.5
                                     : a + (b - a) * random.uniform();
    Vec3 d = random_direction(random);
    if (i % 5 == 0) d = {0, 0, 1};
    if (i % 5 == 1) d = b - a;
    if (i % 5 == 2) d = center - target;
    const Ray ray{target - d * (random.uniform() * 3), d};
    const Hits hits = hits_of(mesh, ray);
    ASSERT_EQ(hits.size() % 2, 0u);
    if (i % 5 == 2 && mesh.contains(center)) {
      ASSERT_GE(hits.size(), 2u);  // through the middle: no leak
    }
    if (i % 5 < 2) continue;  // perhaps along an edge or face, what lies between on the surface
    for (std::size_t k = 0; k + 1 < hits.size(); k += 2) {
      if (hits[k + 1].t - hits[k].t < 1e-9) continue;
      EXPECT_TRUE(mesh.contains(ray.at(0.5 * (hits[k].t + hits[k + 1].t))));
    }
  }
}

TEST(TriangleMeshTest, ClosedMeshesAreWatertight) {
  for (const Specimen& s : zoo()) {
    if (!s.shape->solid() || s.shape->unbounded() || s.name.find("C") == 0) continue;
    if (s.name.ends_with("Revolution")) continue;  // parts are scaled, and may not meet exactly
    const auto soup = s.shape->triangulate(0.5);
    if (!soup) continue;
    SCOPED_TRACE(s.name);
    const TriangleMesh mesh = mesh_of(*soup);
    ASSERT_TRUE(mesh.solid());
    EXPECT_FALSE(mesh.unbounded());
    expect_watertight(mesh, *soup);
  }
}

TEST(TriangleMeshTest, FacesAreSmoothPieces) {
  const TriangleMesh cube = mesh_of(*Box({0, 0, 0}, {1, 1, 1}).triangulate(0.4));
  EXPECT_TRUE(cube.solid());  // its points are shared by place, not by number
  EXPECT_EQ(cube.face_count(), 6u);
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    for (const Hit& h : hits_of(cube, random_line(random, {0.5, 0.5, 0.5}, 0.8, 2))) {
      const Hits same = hits_of(cube, {h.point + h.normal, -h.normal});
      ASSERT_FALSE(same.empty());
      EXPECT_EQ(same.front().face, h.face);
    }
  }
}

TEST(TriangleMeshTest, OpenAndInconsistentMeshesAreNoSolids) {
  TriangleSoup soup = *Box({0, 0, 0}, {1, 1, 1}).triangulate(1);
  TriangleSoup open = soup, twisted = soup, doubled = soup, inverted = soup;
  open.triangles.pop_back();
  std::swap(twisted.triangles[0][0], twisted.triangles[0][1]);
  doubled.triangles.push_back(doubled.triangles[0]);
  flip(inverted);
  EXPECT_TRUE(mesh_of(soup).solid());
  for (const TriangleSoup& bad : {open, twisted, doubled}) {
    EXPECT_FALSE(mesh_of(bad).solid());
    EXPECT_FALSE(mesh_of(bad).contains({0.5, 0.5, 0.5}));
  }
  EXPECT_TRUE(mesh_of(inverted).solid());
  EXPECT_TRUE(mesh_of(inverted).unbounded());
  EXPECT_FALSE(mesh_of(inverted).contains({0.5, 0.5, 0.5}));
  EXPECT_TRUE(mesh_of(inverted).contains({1.5, 0.5, 0.5}));
}

TEST(TriangleMeshTest, OverlappingShellsAreTheirUnion) {
  TriangleSoup soup = *Box({0, 0, 0}, {2, 1, 1}).triangulate(3);
  append(soup, *Box({1, 0.1, 0.2}, {3, 0.9, 0.8}).triangulate(3));
  const TriangleMesh mesh = mesh_of(soup);
  ASSERT_TRUE(mesh.solid());
  const Hits hits = hits_of(mesh, {{-1, 0.5, 0.5}, {1, 0.01, 0.02}});
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_NEAR(hits[0].point.x, 0, 1e-12);
  EXPECT_NEAR(hits[1].point.x, 3, 1e-12);
  EXPECT_TRUE(mesh.contains({1.5, 0.5, 0.5}));
}

TEST(TriangleMeshTest, FineMeshApproachesTheSphere) {
  const Sphere sphere({1, 2, 3}, 2);
  const TriangleMesh mesh = mesh_of(*sphere.triangulate(0.2));
  EXPECT_NEAR(*mesh.area(), *sphere.area(), 1e-9);
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    const Ray ray = random_line(random, {1, 2, 3}, 1.8, 5);
    const Hits hits = hits_of(mesh, ray);
    ASSERT_EQ(hits.size(), 2u);
    EXPECT_NEAR(distance(hits[0].point, {1, 2, 3}), 2, 0.01);
    EXPECT_TRUE(mesh.contains(ray.at(0.5 * (hits[0].t + hits[1].t))));
  }
}

TEST(TriangleMeshTest, RefusesWhatIsNoMesh) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
  EXPECT_NO_THROW(TriangleMesh(points, {{0, 1, 2}}));
  EXPECT_THROW(TriangleMesh(points, {}), InputError);
  EXPECT_THROW(TriangleMesh({}, {{0, 1, 2}}), InputError);
  EXPECT_THROW(TriangleMesh(points, {{0, 1, 4}}), InputError);
  EXPECT_THROW(TriangleMesh(points, {{0, 1, 0xffffffff}}), InputError);
  EXPECT_THROW(TriangleMesh(points, {{0, 1, 1}}), InputError);
  EXPECT_THROW(TriangleMesh(points, {{0, 1, 3}}), InputError);
  EXPECT_THROW(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, {{0, 1, 2}}), InputError);
}

// A ball of many flat triangles, far from the origin.
TEST(TriangleMesh, ItsTreeFindsWhatItsPartsFind) {
  const Vec3 center{1000, 2000, -500};
  const TriangleMesh mesh = mesh_of(*Sphere(center, 1).triangulate(0.1));
  ASSERT_GT(mesh.part_count(), 1000u);
  Random random(5);
  const auto point = [&] {
    return center +
           Vec3{random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5} * 2.4;
  };
  for (int i = 0; i < 1000; ++i) {
    const Vec3 from = point();
    Vec3 way = point() - from;
    if (i % 4 == 0) way.x = 0;
    if (i % 8 == 0) way.y = 0;
    const Ray ray{from, way};
    Hits all, parts;
    mesh.intersect(ray, all);
    bool occluded = false;
    for (std::size_t part = 0; part < mesh.part_count(); ++part) {
      mesh.intersect_part(part, ray, parts);
      occluded = occluded || mesh.part_occludes(part, ray, 0, 1);
    }
    ASSERT_EQ(all.size(), parts.size());
    EXPECT_EQ(mesh.occludes(ray, 0, 1), occluded);
    const double r = distance(from, center);
    if (std::abs(r - 1) > 0.02) {
      EXPECT_EQ(mesh.contains(from), r < 1);
    }
  }
}

}  // namespace
}  // namespace isolux
