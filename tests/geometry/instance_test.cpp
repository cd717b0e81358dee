#include "isolux/geometry/instance.h"

#include <gtest/gtest.h>

#include "geometry/zoo.h"
#include "isolux/core/error.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/tessellation.h"
#include "isolux/geometry/triangle_mesh.h"

namespace isolux {
namespace {

void expect_same_surface(const Shape& a, const Shape& b, bool same_sides = true) {
  Random random(5);
  const Bounds box = b.bounds();
  std::size_t count = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_line(random, box.center(), 0.5 * box.diagonal(), 3);
    const Hits p = hits_of(a, ray), q = hits_of(b, ray);
    ASSERT_EQ(p.size(), q.size());
    for (std::size_t k = 0; k < p.size(); ++k, ++count) {
      EXPECT_NEAR(p[k].t, q[k].t, 1e-9);
      EXPECT_LT(distance(p[k].point, q[k].point), 1e-9);
      EXPECT_LT(distance(p[k].normal, same_sides ? q[k].normal : -q[k].normal), 1e-7);
    }
    EXPECT_EQ(a.contains(ray.at(3)), b.contains(ray.at(3)));
  }
  EXPECT_GT(count, 100u);
}

Affine sheared_mirror() {
  Affine map = Affine::rotate({1, -2, 1}, 1.1) * Affine::scale({1, -1.3, 0.6});
  map.linear[1].z += 0.5;
  map.translation = {3, -2, 1};
  return map;
}

TEST(InstanceTest, SimilarSphere) {
  const Affine map =
      Affine::translate({1, 2, 3}) * Affine::rotate({1, 1, 0}, 2) * Affine::scale({-2, -2, -2});
  const Instance instance(std::make_shared<Sphere>(Vec3{1, 0, 0}, 0.7), map);
  const Sphere direct(map.point({1, 0, 0}), 1.4);
  expect_same_surface(instance, direct);
  EXPECT_NEAR(*instance.area(), *direct.area(), 1e-12);
}

TEST(InstanceTest, MirroredBox) {
  const Instance instance(std::make_shared<Box>(Vec3{0, 1, 2}, Vec3{1, 3, 5}),
                          Affine::scale({2, -1, 1}));
  const Box direct({0, -3, 2}, {2, -1, 5});
  expect_same_surface(instance, direct);
  EXPECT_EQ(instance.bounds().lower, direct.bounds().lower);
  EXPECT_EQ(instance.bounds().upper, direct.bounds().upper);
}

TEST(InstanceTest, ShearedAndMirroredParallelogramKeepsItsSide) {
  const Affine map = sheared_mirror();
  ASSERT_LT(map.determinant(), 0);
  const Vec3 corner{1, 0, 1}, u{1, 0.5, 0}, v{0, 1, 1};
  const Instance instance(std::make_shared<Parallelogram>(corner, u, v), map);
  const Parallelogram direct(map.point(corner), map.vector(u), map.vector(v));
  expect_same_surface(instance, direct, false);  // u × v is mirrored, the lit side is not
}

TEST(InstanceTest, ShearedAndMirroredMesh) {
  const Affine map = sheared_mirror();
  TriangleSoup soup = *Box({0, 0, 0}, {1, 1, 1}).triangulate(0.5);
  const auto mesh = std::make_shared<TriangleMesh>(soup.points, soup.triangles);
  const Instance instance(mesh, map);
  for (Vec3& p : soup.points) p = map.point(p);
  flip(soup);
  const TriangleMesh direct(soup.points, soup.triangles);
  ASSERT_TRUE(direct.solid());
  EXPECT_FALSE(direct.unbounded());
  EXPECT_EQ(instance.part_count(), direct.part_count());
  expect_same_surface(instance, direct);
}

TEST(InstanceTest, TrianglesFaceOutwards) {
  const Affine map = sheared_mirror();
  const Instance instance(std::make_shared<Sphere>(Vec3{}, 1), map);
  const auto soup = instance.triangulate(0.3);
  ASSERT_TRUE(soup);
  for (const auto& [a, b, c] : soup->triangles) {
    const Vec3 &p = soup->points[a], &q = soup->points[b], &r = soup->points[c];
    EXPECT_GT(dot(cross(q - p, r - p), p - map.translation), 0);
    EXPECT_LT(distance(p, q), 0.3 * 1.05);
  }
}

TEST(InstanceTest, RefusesMapsWithoutInverse) {
  const auto ball = std::make_shared<Sphere>(Vec3{}, 1);
  EXPECT_THROW(Instance(ball, Affine::scale({1, 1, 0})), InputError);
  EXPECT_THROW(Instance(ball, Affine::scale({1, 1, std::nan("")})), InputError);
  EXPECT_THROW(Instance(ball, Affine::translate({0, 0, 1e300})), InputError);
  EXPECT_THROW(Instance(nullptr, Affine{}), InputError);
}

}  // namespace
}  // namespace isolux
