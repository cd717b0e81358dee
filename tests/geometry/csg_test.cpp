#include "isolux/geometry/csg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "geometry/zoo.h"
#include "isolux/core/error.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/sphere.h"

namespace isolux {
namespace {

ShapePtr csg(CsgOperation operation, ShapePtr a, ShapePtr b) {
  return std::make_shared<Csg>(operation, std::move(a), std::move(b));
}

ShapePtr inverted(ShapePtr a) { return std::make_shared<Complement>(std::move(a)); }

void expect_same(const Shape& a, const Shape& b) {
  Random random(5);
  const Bounds box = a.bounds();
  EXPECT_EQ(a.unbounded(), b.unbounded());
  EXPECT_EQ(a.bounds().lower, b.bounds().lower);
  EXPECT_EQ(a.bounds().upper, b.bounds().upper);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_line(random, box.center(), 0.5 * box.diagonal(), 3);
    const Hits p = hits_of(a, ray), q = hits_of(b, ray);
    ASSERT_EQ(p.size(), q.size());
    for (std::size_t k = 0; k < p.size(); ++k) {
      EXPECT_EQ(p[k].t, q[k].t);
      EXPECT_EQ(p[k].point, q[k].point);
      EXPECT_EQ(p[k].normal, q[k].normal);
      EXPECT_EQ(p[k].face, q[k].face);
    }
    EXPECT_EQ(a.contains(ray.at(3)), b.contains(ray.at(3)));
  }
}

TEST(CsgTest, DeMorgan) {
  const auto a = std::make_shared<Box>(Vec3{-1, -1, -1}, Vec3{1, 1, 1});
  const auto b = std::make_shared<Cylinder>(Vec3{0, 0, -2}, Vec3{1, 0.5, 2}, 0.6, true);
  expect_same(*csg(CsgOperation::subtract, a, b), *csg(CsgOperation::intersect, a, inverted(b)));
  expect_same(*csg(CsgOperation::unite, a, b),
              *inverted(csg(CsgOperation::intersect, inverted(a), inverted(b))));
}

TEST(CsgTest, EveryLeafKeepsItsFaces) {
  const auto box = std::make_shared<Box>(Vec3{-1, -1, -1}, Vec3{1, 1, 1});
  const auto rod = std::make_shared<Cylinder>(Vec3{0, 0, -2}, Vec3{0, 0, 2}, 0.5, true);
  const auto ball = std::make_shared<Sphere>(Vec3{1, 0, 0}, 0.6);
  const auto solid = csg(CsgOperation::unite, csg(CsgOperation::subtract, box, ball), rod);
  EXPECT_EQ(solid->face_count(), 6u + 1 + 3);
  std::set<std::uint32_t> met;
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    for (const Hit& h : hits_of(*solid, random_line(random, {}, 2.5, 5))) {
      met.insert(h.face);
      if (h.face == 6) {
        EXPECT_NEAR(distance(h.point, {1, 0, 0}), 0.6, 1e-12);
      }
      if (h.face < 6) {
        EXPECT_NEAR(std::abs(h.point[static_cast<int>(h.face / 2)]), 1, 1e-12);
      }
      if (h.face == 7) {
        EXPECT_NEAR(std::hypot(h.point.x, h.point.y), 0.5, 1e-12);
      }
      if (h.face > 7) {
        EXPECT_NEAR(std::abs(h.point.z), 2, 1e-12);
      }
    }
  }
  EXPECT_THAT(met, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
}

TEST(CsgTest, CoincidentBoundariesAreOne) {
  const auto low = std::make_shared<Box>(Vec3{0, 0, 0}, Vec3{1, 1, 0.3});
  const auto high = std::make_shared<Box>(Vec3{0, 0, 0.1 + 0.2}, Vec3{1, 1, 1});  // 1 ulp above
  const auto rod = std::make_shared<Cylinder>(Vec3{0.5, 0.5, 0}, Vec3{0.5, 0.5, 0.3}, 0.2, true);
  const auto stack = csg(CsgOperation::unite, low, high);
  const auto cut_off = csg(CsgOperation::subtract, low, high);
  const auto drilled = csg(CsgOperation::subtract, low, rod);
  const auto itself = csg(CsgOperation::subtract, low, low);
  const auto twice = csg(CsgOperation::intersect, low, low);
  Random random(9);
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random_line(random, {0.5, 0.5, 0.3}, 0.8, 4);
    EXPECT_LE(hits_of(*stack, ray).size(), 2u);
    EXPECT_EQ(hits_of(*cut_off, ray).size(), hits_of(*low, ray).size());
    EXPECT_TRUE(hits_of(*itself, ray).empty());
    EXPECT_EQ(hits_of(*twice, ray).size(), hits_of(*low, ray).size());
    for (const Hit& h : hits_of(*twice, ray)) EXPECT_LT(h.face, 6u);
    for (const Hit& h : hits_of(*drilled, ray)) {  // no lid over the hole
      EXPECT_TRUE(h.face <= 6) << h.face;
      if (h.face == 4 || h.face == 5) {
        EXPECT_GT(std::hypot(h.point.x - 0.5, h.point.y - 0.5), 0.2 - 1e-9);
      }
    }
  }
}

TEST(CsgTest, OnlyTheEndsOfStackedBoxesAreBoundary) {
  const auto stack = csg(CsgOperation::unite, std::make_shared<Box>(Vec3{0, 0, 0}, Vec3{1, 1, 0.3}),
                         std::make_shared<Box>(Vec3{0, 0, 0.3}, Vec3{1, 1, 1}));
  const Hits hits = hits_of(*stack, {{0.4, 0.6, 1e4}, {0, 0, -1}});
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].point, (Vec3{0.4, 0.6, 1}));
  EXPECT_EQ(hits[1].point, (Vec3{0.4, 0.6, 0}));
}

TEST(CsgTest, RefusesWhatIsNoSolid) {
  const auto ball = std::make_shared<Sphere>(Vec3{}, 1);
  const auto disk = std::make_shared<Disk>(Vec3{}, Vec3{0, 0, 1}, 1);
  const auto pipe = std::make_shared<Cylinder>(Vec3{}, Vec3{0, 0, 1}, 1, false);
  const auto far = std::make_shared<Sphere>(Vec3{5, 0, 0}, 1);
  EXPECT_THROW(csg(CsgOperation::unite, ball, disk), InputError);
  EXPECT_THROW(csg(CsgOperation::subtract, pipe, ball), InputError);
  EXPECT_THROW(csg(CsgOperation::unite, ball, nullptr), InputError);
  EXPECT_THROW(csg(CsgOperation::intersect, ball, far), InputError);
  EXPECT_NO_THROW(csg(CsgOperation::subtract, ball, far));
  EXPECT_THROW(inverted(disk), InputError);
}

}  // namespace
}  // namespace isolux
