#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "formats/mgf_text.h"
#include "isolux/geometry/instance.h"
#include "isolux/scene/scene.h"

namespace isolux {
namespace {
using std::numbers::pi;

/// The middle of a small ball at (1, 0, 0) under a transform.
Vec3 moved(const std::string& transform) {
  return only_object(kVertices + "xf " + transform + "\nsph x 0.01\nxf\n").shape->bounds().center();
}

std::vector<Vec3> places(const std::string& text) {
  std::vector<Vec3> list;
  for (const Object& o : read_text(kVertices + text).scene.objects) {
    list.push_back(o.shape->bounds().center());
  }
  return list;
}

void expect_places(const std::string& text, const std::vector<Vec3>& expected) {
  const std::vector<Vec3> found = places(text);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) expect_near(found[i], expected[i], 1e-9);
}

TEST(MgfTransform, EachStep) {
  expect_near(moved("-t 1 2 3"), {2, 2, 3});
  expect_near(moved("-rx 90"), {1, 0, 0});
  expect_near(moved("-ry 90"), {0, 0, -1});
  expect_near(moved("-rz 90"), {0, 1, 0});
  expect_near(moved("-s 2.5"), {2.5, 0, 0});
  expect_near(moved("-mx"), {-1, 0, 0});
  expect_near(moved("-my"), {1, 0, 0});
  expect_near(moved("-sx 3 -sy 2 -sz 2"), {3, 0, 0});
}

TEST(MgfTransform, StepsActFromTheLeft) {
  expect_near(moved("-t 1 0 0 -rz 90"), {0, 2, 0});
  expect_near(moved("-rz 90 -t 1 0 0"), {1, 1, 0});
  expect_near(moved("-i 3 -t 1 0 0 -rz 90 -i 1 -s 2"), {-2, -2, 0});
}

TEST(MgfTransform, TheInnerActsBeforeTheOuter) {
  expect_places("xf -rz 90\nxf -t 1 0 0\nsph x 1\nxf\nsph x 1\nxf\nsph x 1\n",
                {{0, 2, 0}, {0, 1, 0}, {1, 0, 0}});
}

TEST(MgfTransform, Array) {
  expect_places("xf -a 3 -t 2 0 0\nsph o 1\nxf\n", {{0, 0, 0}, {2, 0, 0}, {4, 0, 0}});
  expect_places("xf -t 0 0 1 -a 2 -rz 90 -i 1 -t 5 0 0\nsph x 1\nxf\n", {{6, 0, 1}, {5, 1, 1}});
}

TEST(MgfTransform, ArraysMultiply) {
  expect_places("xf -a 2 -t 1 0 0 -a 3 -t 0 10 0\nsph o 1\nxf\n",
                {{0, 0, 0}, {1, 0, 0}, {0, 10, 0}, {1, 10, 0}, {0, 20, 0}, {1, 20, 0}});
  expect_places("xf -a 2 -t 10 0 0\nxf -a 2 -t 1 0 0\nsph o 1\nxf\nxf\n",
                {{0, 0, 0}, {1, 0, 0}, {10, 0, 0}, {11, 0, 0}});
}

TEST(MgfTransform, ContextsSetInsideOneAreNotMoved) {
  expect_places("xf -t 1 0 0\nv w =\n p 0 0 5\nxf\nsph w 1\n", {{0, 0, 5}});
}

TEST(MgfTransform, MirrorsKeepNormals) {
  // A face that looks up still does so, beside its mirror image; one that looks along x looks back.
  for (const std::string face : {"f o x xy y", "f o x y", "ring z 0 1"}) {
    for (const Object& o : read_text(kVertices + "xf -a 2 -mx\n" + face + "\nxf\n").scene.objects) {
      const Vec3 c = o.shape->bounds().center();
      const Hits hits = hits_along(*o.shape, {c.x * 0.5, 0.3, 5}, {0, 0, -1});
      ASSERT_EQ(hits.size(), 1u) << face;
      expect_near(hits[0].normal, {0, 0, 1});
    }
  }
  const Object wall = only_object(kVertices + "xf -mx\nf o y z\nxf\n");
  expect_near(hits_along(*wall.shape, {5, 0.2, 0.2}, {-1, 0, 0}).at(0).normal, {-1, 0, 0});
  const Object prism = only_object(kVertices + "xf -mx\nprism o x xy y 1\nxf\n");
  EXPECT_FALSE(prism.shape->unbounded());
  EXPECT_NEAR(volume_of(*prism.shape), 1, 1e-12);
  const Object bubble = only_object(kVertices + "xf -s -2\nsph o -1\nxf\n");
  expect_near(hits_along(*bubble.shape, {5, 0, 0}, {-1, 0, 0}).at(0).normal, {-1, 0, 0});
  expect_near(bubble.shape->bounds().upper, {2, 2, 2});
}

TEST(MgfTransform, SimilaritiesAreAppliedToTheNumbers) {
  const std::string xf = "xf -rx 30 -s 2 -t 1 2 3 -my\n";
  const auto area = [&](const std::string& entity) {
    return only_object(kVertices + xf + entity + "\nxf\n").shape->area().value();
  };
  EXPECT_NEAR(area("sph x 1"), 16 * pi, 1e-9);
  EXPECT_NEAR(area("cyl o 1 z"), 8 * pi, 1e-9);
  EXPECT_NEAR(area("cone o 1 z 0"), 4 * pi * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(area("ring z 1 2"), 12 * pi, 1e-9);
  EXPECT_NEAR(area("torus z 1 3"), 32 * pi * pi, 1e-9);
  EXPECT_NEAR(area("f o x xy y"), 4, 1e-9);
}

TEST(MgfTransform, UnevenScalesMakeEllipsoidsAndStretchFaces) {
  const Object egg = only_object(kVertices + "xf -sz 3 -t 0 0 1\nsph o 1\nxf\n");
  expect_near(egg.shape->bounds().lower, {-1, -1, -2});
  expect_near(egg.shape->bounds().upper, {1, 1, 4});
  EXPECT_TRUE(egg.shape->contains({0, 0, 3.9}));
  EXPECT_FALSE(egg.shape->contains({0.9, 0, 3}));
  const SceneFile eggs = read_text(kVertices + "xf -sz 3 -a 3 -t 5 0 0\nsph o 1\nxf\n");
  expect_near(eggs.scene.objects.at(2).shape->bounds().lower, {9, -1, -3});
  const Object face = only_object(kVertices + "xf -sx 3\nf o x xy y\nxf\n");
  EXPECT_DOUBLE_EQ(face.shape->area().value(), 3);
}

TEST(MgfTransform, ArraysShareWhatTakesManyNumbers) {
  const auto distinct = [](const std::string& entity) {
    std::set<const Shape*> shapes;
    const auto file =
        read_text(kVertices + "xf -rz 30 -a 5 -t 2 0 0 -i 1 -mx\n" + entity + "\nxf\n");
    for (const Object& object : file.scene.objects) {
      shapes.insert(original(object.shape).shape.get());
    }
    return shapes.size();
  };
  EXPECT_EQ(distinct("prism o x y 1"), 1u);
  EXPECT_EQ(distinct("prism o x y -1"), 1u);
  EXPECT_EQ(distinct("f o x xy z"), 1u);
  EXPECT_EQ(distinct("f o x xy y"), 5u);
  EXPECT_EQ(distinct("sph o 1"), 5u);
}

TEST(MgfTransform, SharedShapesStandWhereTheirOwnWould) {
  const std::string array = "xf -rz 30 -a 3 -t 2 0 0 -i 1 -mx\nprism o x y 0.5\nxf\n";
  const std::string third = "xf -rz 30 -i 2 -t 2 0 0 -i 1 -mx\nprism o x y 0.5\nxf\n";
  const auto shared_shape = read_text(kVertices + array).scene.objects.at(2).shape;
  const auto own_shape = only_object(kVertices + third).shape;
  const Shape &shared = *shared_shape, &alone = *own_shape;
  EXPECT_NEAR(volume_of(shared), 0.25, 1e-12);
  const Hits hits = hits_along(alone, {-4.1, 0.45, 5}, {0, 0, -1});
  const Hits same = hits_along(shared, {-4.1, 0.45, 5}, {0, 0, -1});
  ASSERT_EQ(hits.size(), 2u);
  ASSERT_EQ(same.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    expect_near(same[i].point, hits[i].point);
    expect_near(same[i].normal, hits[i].normal);
  }
}

TEST(MgfTransform, AHundredThousandObjects) {
  const SceneFile file =
      read_text(kVertices + "xf -a 1000 -t 3 0 0 -a 100 -t 0 3 0\nsph o 1\nxf\n");
  EXPECT_EQ(file.scene.objects.size(), 100'000u);
  expect_near(file.scene.bounds().upper, {2998, 298, 1});
}

}  // namespace
}  // namespace isolux
