#include "isolux/formats/radiance/write_radiance.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <numbers>
#include <sstream>

#include "formats/one_object.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"

namespace isolux {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using ShapePtr = std::shared_ptr<const Shape>;

/// What follows the one material.
std::string surfaces(ShapePtr shape) {
  const std::string text = write_radiance(one_object(std::move(shape))).text;
  return text.substr(text.find("\n\n") + 2);
}

TEST(WriteRadiance, TheWholeOfASmallScene) {
  const WrittenScene written =
      write_radiance(one_object(std::make_shared<Sphere>(Vec3{1, 2, 3}, 0.5)));
  EXPECT_EQ(written.text,
            "void plastic gray\n"
            "0\n"
            "0\n"
            "5 0.5 0.5 0.5 0 0\n"
            "\n"
            "gray sphere thing\n"
            "0\n"
            "0\n"
            "4 1 2 3 0.5\n"
            "\n");
  EXPECT_THAT(written.notes, IsEmpty());
}

TEST(WriteRadiance, RoundSurfacesStayRound) {
  EXPECT_EQ(surfaces(std::make_shared<Cylinder>(Vec3{}, Vec3{0, 0, 2}, 0.5, false)),
            "gray cylinder thing\n0\n0\n7 0 0 0 0 0 2 0.5\n\n");
  EXPECT_EQ(surfaces(std::make_shared<Frustum>(Vec3{}, Vec3{0, 0, 2}, 1, 0.5, false)),
            "gray cone thing\n0\n0\n8 0 0 0 0 0 2 1 0.5\n\n");
  EXPECT_EQ(surfaces(std::make_shared<Disk>(Vec3{1, 0, 0}, Vec3{0, 0, 2}, 3, 1)),
            "gray ring thing\n0\n0\n8 1 0 0 0 0 1 1 3\n\n");
}

TEST(WriteRadiance, WhatFacesInwardHasANameOfItsOwn) {
  const auto inside_out = [](ShapePtr shape) {
    return surfaces(std::make_shared<Complement>(std::move(shape)));
  };
  EXPECT_THAT(inside_out(std::make_shared<Sphere>(Vec3{}, 0.5)), StartsWith("gray bubble"));
  EXPECT_THAT(inside_out(std::make_shared<Cylinder>(Vec3{}, Vec3{0, 0, 2}, 0.5, true)),
              StartsWith("gray tube"));
  EXPECT_THAT(inside_out(std::make_shared<Frustum>(Vec3{}, Vec3{0, 0, 2}, 0.5, 1, true)),
              StartsWith("gray cup"));
}

TEST(WriteRadiance, FlatSurfacesBecomePolygons) {
  EXPECT_EQ(surfaces(std::make_shared<Parallelogram>(Vec3{}, Vec3{2, 0, 0}, Vec3{0, 1, 0})),
            "gray polygon thing\n0\n0\n12\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n\n");
  const std::string box = surfaces(std::make_shared<Box>(Vec3{}, Vec3{1, 2, 3}));
  EXPECT_THAT(box, HasSubstr("12\n0 0 3\n1 0 3\n1 2 3\n0 2 3\n"));  // the top, from above
}

/// The volume that the polygons of a text enclose, m³; negative where they face inward.
double volume(const std::string& text) {
  std::istringstream in(text.substr(text.find(" polygon ")));
  double sum = 0;
  std::string word;
  while (in >> word) {
    if (word != "thing") continue;
    std::size_t words = 0, integers = 0, count = 0;
    in >> words >> integers >> count;
    std::vector<Vec3> corners(count / 3);
    for (Vec3& p : corners) in >> p.x >> p.y >> p.z;
    for (std::size_t i = 2; i < corners.size(); ++i) {
      sum += dot(corners[0], cross(corners[i - 1], corners[i])) / 6;
    }
  }
  return sum;
}

TEST(WriteRadiance, PolygonsFaceTheWayTheShapeDid) {
  const auto box = std::make_shared<Box>(Vec3{1, 1, 1}, Vec3{2, 3, 4});
  const auto room = std::make_shared<Complement>(box);
  Affine mirror = Affine::scale({1, -1, 2});
  mirror.linear[0].z = 0.5;
  EXPECT_NEAR(volume(surfaces(box)), 6, 1e-12);
  EXPECT_NEAR(volume(surfaces(room)), -6, 1e-12);
  EXPECT_NEAR(volume(surfaces(std::make_shared<Instance>(box, mirror))), 12, 1e-12);
  EXPECT_NEAR(volume(surfaces(std::make_shared<Instance>(room, mirror))), -12, 1e-12);
  // Cut into triangles; their area is that of the true surface, so the volume is a little more.
  const auto ball = std::make_shared<Sphere>(Vec3{}, 1);
  const double egg = volume(surfaces(std::make_shared<Instance>(ball, mirror)));
  EXPECT_NEAR(egg, 8 * std::numbers::pi / 3, 0.01 * egg);
}

TEST(WriteRadiance, LightIsRadianceOfThePublishedEfficacy) {
  Scene scene = one_object(std::make_shared<Disk>(Vec3{}, Vec3{0, 0, -1}, 0.5));
  scene.objects[0].sides = Sides::front;
  scene.objects[0].exitance = {179 * std::numbers::pi, 0, 17.9 * std::numbers::pi};
  const WrittenScene written = write_radiance(scene);
  double r = 0, g = 0, b = 0;
  ASSERT_EQ(std::sscanf(written.text.c_str(), "void light gray\n0\n0\n3 %lf %lf %lf", &r, &g, &b),
            3);
  // The luminance is 179 lm/W times 0.265 R + 0.670 G + 0.065 B, as Radiance weighs its channels.
  EXPECT_NEAR(0.265 * r + 0.670 * g + 0.065 * b, 0.2126 * 1 + 0.0722 * 0.1, 1e-12);
  EXPECT_EQ(g, 0);
  EXPECT_NEAR(b, 0.1 * r, 1e-12);
  scene.objects[0].exitance = gray(179 * std::numbers::pi);
  const std::string white = write_radiance(scene).text;
  ASSERT_EQ(std::sscanf(white.c_str(), "void light gray\n0\n0\n3 %lf %lf %lf", &r, &g, &b), 3);
  EXPECT_NEAR(r, 1, 1e-12);
  EXPECT_EQ(r, g);
  EXPECT_EQ(r, b);
  EXPECT_THAT(written.notes, ElementsAre("lights lose their reflectance"));
  scene.materials[0].reflectance = {};
  EXPECT_THAT(write_radiance(scene).notes, IsEmpty());
}

TEST(WriteRadiance, WhatIsLostIsNoted) {
  Scene scene = one_object(std::make_shared<Parallelogram>(Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}));
  EXPECT_THAT(write_radiance(scene).notes, IsEmpty());
  scene.objects[0].sides = Sides::front;
  scene.cameras = {{"eye", {}, {1, 0, 0}}};
  EXPECT_THAT(write_radiance(scene).notes,
              ElementsAre("cameras are left out (1): Radiance has none", HasSubstr("backs")));
}

// Dual contouring on 32 cells: the points lie on the surface, the middles of triangles within.
TEST(WriteRadiance, WhatHasNoTrianglesIsApproximated) {
  const auto torus = std::make_shared<Torus>(Vec3{}, Vec3{0, 0, 1}, 2, 0.5);
  EXPECT_NEAR(volume(surfaces(torus)), std::numbers::pi * std::numbers::pi, 0.1);
  const auto room = std::make_shared<Complement>(torus);
  EXPECT_NEAR(volume(surfaces(room)), -std::numbers::pi * std::numbers::pi, 0.1);
  EXPECT_THAT(write_radiance(one_object(torus)).notes,
              ElementsAre(HasSubstr("triangles stand for what Radiance does not have, up to 0.0")));
  // Edges stay sharp: half a box, cut from a whole one.
  const auto box = std::make_shared<Box>(Vec3{}, Vec3{2, 2, 2});
  const auto half = std::make_shared<Csg>(CsgOperation::subtract, box,
                                          std::make_shared<Box>(Vec3{1, -1, -1}, Vec3{3, 3, 3}));
  EXPECT_NEAR(volume(surfaces(half)), 4, 1e-3);
  // A wall thinner than a cell.
  const auto cut =
      std::make_shared<Csg>(CsgOperation::subtract, box,
                            std::make_shared<Box>(Vec3{0.01, 0.01, 0.01}, Vec3{1.99, 1.99, 3}));
  EXPECT_THAT(write_radiance(one_object(cut)).notes,
              testing::Contains(HasSubstr("may be missing: 'thing'")));
}

}  // namespace
}  // namespace isolux
