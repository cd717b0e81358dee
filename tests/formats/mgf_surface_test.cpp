#include <gmock/gmock.h>

#include <numbers>

#include "formats/mgf_text.h"
#include "isolux/scene/scene.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::ElementsAre;

Object surface(const std::string& entity) { return only_object(kVertices + entity + "\n"); }

double area(const Object& object) { return surface_area(*object.shape).value(); }

TEST(MgfSurface, FaceLooksWhereItsVerticesRunCounterClockwise) {
  const Object triangle = surface("f o x y");
  EXPECT_DOUBLE_EQ(area(triangle), 0.5);
  expect_near(hits_along(*triangle.shape, {0.2, 0.2, 1}, {0, 0, -1}).at(0).normal, {0, 0, 1});
  const Object square = surface("f o y xy x");
  EXPECT_DOUBLE_EQ(area(square), 1);
  expect_near(hits_along(*square.shape, {0.2, 0.2, 1}, {0, 0, -1}).at(0).normal, {0, 0, -1});
}

TEST(MgfSurface, ConcaveFace) {
  const Object arrow = surface("v in =\n p 0.25 0.25 0\nf o x in y");
  EXPECT_DOUBLE_EQ(area(arrow), 0.25);
  EXPECT_TRUE(hits_along(*arrow.shape, {0.3, 0.3, 1}, {0, 0, -1}).empty());
}

/// A square of 4 by 4 m with two square holes, of 1 by 1 and of 0.5 by 0.5 m.
const std::string kFrame =
    "v a =\n p 0 0 0\nv b =\n p 4 0 0\nv c =\n p 4 4 0\nv d =\n p 0 4 0\n"
    "v e =\n p 1 1 0\nv f =\n p 2 1 0\nv g =\n p 2 2 0\nv h =\n p 1 2 0\n"
    "v i =\n p 3 3 0\nv j =\n p 3.5 3 0\nv k =\n p 3.5 3.5 0\nv l =\n p 3 3.5 0\n";

void expect_frame(const Object& frame) {
  EXPECT_NEAR(area(frame), 16 - 1 - 0.25, 1e-12);
  const auto is_hit = [&](double x, double y) {
    return !hits_along(*frame.shape, {x, y, 1}, {0, 0, -1}).empty();
  };
  EXPECT_TRUE(is_hit(0.5, 0.5));
  EXPECT_TRUE(is_hit(2.5, 2.5));
  EXPECT_TRUE(is_hit(3.9, 3.2));
  EXPECT_FALSE(is_hit(1.5, 1.5));
  EXPECT_FALSE(is_hit(3.2, 3.2));
  EXPECT_FALSE(is_hit(4.1, 2));
  expect_near(hits_along(*frame.shape, {0.5, 0.5, 1}, {0, 0, -1}).at(0).normal, {0, 0, 1});
}

TEST(MgfSurface, HolesOfAFaceWithHolesMayRunEitherWay) {
  expect_frame(surface(kFrame + "fh a b c d - h g f e - l k j i"));
  expect_frame(surface(kFrame + "fh a b c d - e f g h - i j k l"));
}

TEST(MgfSurface, SeamsOfAFaceAreHoles) {
  expect_frame(surface(kFrame + "f a b c k j i l k c d a e h g f e"));
}

TEST(MgfSurface, ASeamMayRunAlongPartOfASide) {
  // The hole's lower side runs on to the vertex q in the middle of the right side, and back.
  const Object wall = surface(
      "v a =\n p 0 0 0\nv b =\n p 4 0 0\nv q =\n p 4 1 0\nv c =\n p 4 4 0\nv d =\n p 0 4 0\n"
      "v e =\n p 3 1 0\nv f =\n p 3 2 0\nv g =\n p 1 2 0\nv h =\n p 1 1 0\n"
      "f a b q h g f e q c d");
  EXPECT_NEAR(area(wall), 16 - 2, 1e-12);
  EXPECT_TRUE(hits_along(*wall.shape, {2, 1.5, 1}, {0, 0, -1}).empty());
  EXPECT_EQ(hits_along(*wall.shape, {3.5, 1.5, 1}, {0, 0, -1}).size(), 1u);
  EXPECT_EQ(hits_along(*wall.shape, {3.5, 1, 1}, {0, 0, -1}).size(), 1u);
}

TEST(MgfSurface, FaceOffItsPlaneKeepsItsCorners) {
  const SceneFile file = read_text(kVertices + "v up =\n p 1 1 0.1\nf o x up y\n");
  const Shape& shape = *file.scene.objects.at(0).shape;
  EXPECT_EQ(shape.part_count(), 2u);
  EXPECT_DOUBLE_EQ(shape.bounds().upper.z, 0.1);
  EXPECT_THAT(file.notes,
              ElementsAre("1 face with corners off the plane: cut into flat triangles"));
}

TEST(MgfSurface, Sphere) {
  const Object ball = surface("sph x 0.5");
  EXPECT_DOUBLE_EQ(area(ball), pi);
  EXPECT_TRUE(ball.shape->solid());
  EXPECT_TRUE(ball.shape->contains({1.4, 0, 0}));
  expect_near(hits_along(*ball.shape, {1, 0, 2}, {0, 0, -1}).at(0).normal, {0, 0, 1});
}

TEST(MgfSurface, NegativeRadiiFaceInward) {
  const Object bubble = surface("sph x -0.5");
  EXPECT_DOUBLE_EQ(area(bubble), pi);
  EXPECT_FALSE(bubble.shape->solid());
  EXPECT_EQ(bubble.sides, Sides::both);
  expect_near(hits_along(*bubble.shape, {1, 0, 2}, {0, 0, -1}).at(0).normal, {0, 0, -1});
  EXPECT_NEAR(volume_of(*bubble.shape, 0.01), -pi / 6, 1e-3);
  expect_near(hits_along(*surface("cyl o -0.5 z").shape, {2, 0, 0.5}, {-1, 0, 0}).at(0).normal,
              {-1, 0, 0});
  const Vec3 slant =
      hits_along(*surface("cone o -1 z 0").shape, {2, 0, 0.5}, {-1, 0, 0}).at(0).normal;
  expect_near(slant, Vec3{-1, 0, -1} / std::sqrt(2.0));
  expect_near(hits_along(*surface("torus z -1 -3").shape, {9, 0, 1}, {-1, 0, 0}).at(0).normal,
              {-1, 0, 0});
}

TEST(MgfSurface, CylinderIsAnOpenTube) {
  const Object tube = surface("cyl o 0.5 z");
  EXPECT_DOUBLE_EQ(area(tube), pi);
  EXPECT_FALSE(tube.shape->solid());
  EXPECT_TRUE(hits_along(*tube.shape, {0, 0, 2}, {0, 0, -1}).empty());
  const Hits hits = hits_along(*tube.shape, {2, 0, 0.5}, {-1, 0, 0});
  ASSERT_EQ(hits.size(), 2u);
  expect_near(hits[0].normal, {1, 0, 0});
  expect_near(hits[1].normal, {-1, 0, 0});
}

TEST(MgfSurface, ConeIsAnOpenFrustum) {
  EXPECT_DOUBLE_EQ(area(surface("cone o 2 z 1")), 3 * pi * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(area(surface("cone o 0 z 1")), pi * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(area(surface("cone o 1 z 1")), 2 * pi);
}

TEST(MgfSurface, RingFacesItsNormal) {
  const Object ring = surface("ring z 1 2");
  EXPECT_DOUBLE_EQ(area(ring), 3 * pi);
  EXPECT_TRUE(hits_along(*ring.shape, {0.5, 0, 2}, {0, 0, -1}).empty());
  expect_near(hits_along(*ring.shape, {1.5, 0, 2}, {0, 0, -1}).at(0).normal, {0, 0, 1});
  EXPECT_DOUBLE_EQ(area(surface("ring z 0 2")), 4 * pi);
}

TEST(MgfSurface, TorusLiesBetweenItsRadii) {
  const Object torus = surface("torus z 1 3");
  EXPECT_DOUBLE_EQ(area(torus), 4 * pi * pi * 2 * 1);
  expect_near(torus.shape->bounds().lower, {-3, -3, 0});
  expect_near(torus.shape->bounds().upper, {3, 3, 2});
  EXPECT_NEAR(area(surface("torus z 0 2")), 4 * pi * pi, 1e-6);
}

TEST(MgfSurface, PrismIsClosedAndGoesAwayFromItsEndFace) {
  const Object prism = surface("prism o x xy y 2");
  EXPECT_TRUE(prism.shape->solid());
  EXPECT_FALSE(prism.shape->unbounded());
  EXPECT_NEAR(area(prism), 10, 1e-12);
  EXPECT_NEAR(volume_of(*prism.shape), 2, 1e-12);
  expect_near(prism.shape->bounds().lower, {0, 0, -2});
  expect_near(hits_along(*prism.shape, {0.5, 0.4, 2}, {0, 0, -1}).at(0).normal, {0, 0, 1});
}

TEST(MgfSurface, PrismOfNegativeLengthGoesTheOtherWayAndFacesInward) {
  const Object prism = surface("prism o x xy y -2");
  EXPECT_FALSE(prism.shape->solid());
  EXPECT_NEAR(volume_of(*prism.shape), -2, 1e-12);
  expect_near(prism.shape->bounds().upper, {1, 1, 2});
  expect_near(hits_along(*prism.shape, {0.5, 0.4, 3}, {0, 0, -1}).at(0).normal, {0, 0, -1});
}

TEST(MgfSurface, PrismOfAConcaveEndWithAHole) {
  const Object prism = surface(kFrame + "prism a b c k j i l k c d a e h g f e 0.5");
  EXPECT_TRUE(prism.shape->solid());
  EXPECT_NEAR(volume_of(*prism.shape), (16 - 1 - 0.25) * 0.5, 1e-12);
  EXPECT_NEAR(area(prism), 2 * (16 - 1 - 0.25) + 0.5 * (16 + 4 + 2), 1e-12);
}

TEST(MgfSurface, WhatHasNoAreaIsLeftOutAndCounted) {
  const SceneFile file =
      read_text(kVertices +
                "f o x x\nf o x o\nsph o 0\ncyl o 1 o\ncyl o 0 z\ncone o 0 z 0\n"
                "ring z 1 1\ntorus z 1 1\nprism o x xy y 0\nprism o x x 1\nf o x y\n");
  EXPECT_EQ(file.scene.objects.size(), 1u);
  EXPECT_THAT(file.notes, ElementsAre("10 surfaces without area: left out"));
}

TEST(MgfSurface, VertexNormalsDoNotBendAFace) {
  const SceneFile file =
      read_text(kVertices + "v x\n n 1 0 0\nv xy\n n 0 0 -3\nf o x xy\nf o xy y\n");
  EXPECT_THAT(file.notes, ElementsAre("1 face with vertex normals (n): kept flat"));
  const Shape& shape = *file.scene.objects.at(0).shape;
  expect_near(hits_along(shape, {0.9, 0.1, 1}, {0, 0, -1}).at(0).normal, {0, 0, 1});
}

}  // namespace
}  // namespace isolux
