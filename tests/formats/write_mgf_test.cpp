#include "isolux/formats/mgf/write_mgf.h"

#include <gmock/gmock.h>

#include <numbers>

#include "formats/one_object.h"
#include "isolux/formats/mgf/mgf.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/cylinder.h"
#include "isolux/geometry/disk.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/polygon.h"
#include "isolux/geometry/sphere.h"
#include "isolux/geometry/torus.h"
#include "isolux/geometry/triangle_mesh.h"
#include "isolux/scene/reader.h"

namespace isolux {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

using ShapePtr = std::shared_ptr<const Shape>;

/// The lines between "o thing" and "o".
std::string surfaces(ShapePtr shape) {
  const std::string text = write_mgf(one_object(std::move(shape))).text;
  const std::size_t start = text.find("o thing\n") + 8, end = text.rfind("o\n");
  return text.substr(start, end - start);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t i = text.find(part); i != text.npos; i = text.find(part, i + 1)) ++n;
  return n;
}

TEST(WriteMgf, TheWholeOfASmallScene) {
  const WrittenScene written = write_mgf(one_object(std::make_shared<Sphere>(Vec3{1, 2, 3}, 0.5)));
  EXPECT_EQ(written.text,
            "m gray =\n"
            "\tsides 1\n"
            "\tc\n"
            "\trd 0.5\n"
            "\n"
            "m gray\n"
            "o thing\n"
            "v v0 =\n"
            "\tp 1 2 3\n"
            "sph v0 0.5\n"
            "o\n");
  EXPECT_THAT(written.notes, IsEmpty());
}

TEST(WriteMgf, RoundSurfacesStayRound) {
  EXPECT_EQ(surfaces(std::make_shared<Cylinder>(Vec3{}, Vec3{0, 0, 2}, 0.5, false)),
            "v v0 =\n\tp 0 0 0\nv v1 =\n\tp 0 0 2\ncyl v0 0.5 v1\n");
  EXPECT_EQ(surfaces(std::make_shared<Frustum>(Vec3{}, Vec3{0, 0, 2}, 1, 0, true)),
            "v v0 =\n\tp 0 0 0\nv v1 =\n\tp 0 0 2\ncone v0 1 v1 0\n"
            "v v0 =\n\tp 0 0 0\n\tn 0 0 -1\nring v0 0 1\n");
  EXPECT_EQ(surfaces(std::make_shared<Disk>(Vec3{1, 0, 0}, Vec3{0, 0, 2}, 3, 1)),
            "v v0 =\n\tp 1 0 0\n\tn 0 0 1\nring v0 1 3\n");
  EXPECT_EQ(surfaces(std::make_shared<Torus>(Vec3{}, Vec3{0, 1, 0}, 2, 0.5)),
            "v v0 =\n\tp 0 0 0\n\tn 0 1 0\ntorus v0 1.5 2.5\n");
}

TEST(WriteMgf, WhatFacesInwardHasNegativeRadii) {
  const auto inside_out = [](ShapePtr shape) {
    return surfaces(std::make_shared<Complement>(std::move(shape)));
  };
  EXPECT_THAT(inside_out(std::make_shared<Sphere>(Vec3{}, 0.5)), HasSubstr("sph v0 -0.5\n"));
  EXPECT_THAT(inside_out(std::make_shared<Torus>(Vec3{}, Vec3{0, 0, 1}, 2, 0.5)),
              HasSubstr("torus v0 -1.5 -2.5\n"));
  const std::string tube = inside_out(std::make_shared<Cylinder>(Vec3{}, Vec3{0, 0, 2}, 0.5, true));
  EXPECT_THAT(tube, HasSubstr("cyl v0 -0.5 v1\n"));
  EXPECT_THAT(tube, HasSubstr("p 0 0 0\n\tn 0 0 1\n"));
}

TEST(WriteMgf, FlatSurfacesBecomeFaces) {
  EXPECT_EQ(surfaces(std::make_shared<Parallelogram>(Vec3{}, Vec3{2, 0, 0}, Vec3{0, 1, 0})),
            "v v0 =\n\tp 0 0 0\nv v1 =\n\tp 2 0 0\nv v2 =\n\tp 2 1 0\nv v3 =\n\tp 0 1 0\n"
            "f v0 v1 v2 v3\n");
  const std::string box = surfaces(std::make_shared<Box>(Vec3{}, Vec3{1, 2, 3}));
  EXPECT_EQ(count(box, "v v"), 8u);
  EXPECT_EQ(count(box, "\nf "), 6u);
  EXPECT_THAT(box, HasSubstr("f v4 v5 v7 v6\n"));  // the top, from above
  const std::string room =
      surfaces(std::make_shared<Complement>(std::make_shared<Box>(Vec3{}, Vec3{1, 2, 3})));
  EXPECT_THAT(room, HasSubstr("f v6 v7 v5 v4\n"));
  const std::string mesh = surfaces(std::make_shared<TriangleMesh>(
      std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
      std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {2, 3, 0}}));
  EXPECT_EQ(count(mesh, "v v"), 4u);
  EXPECT_THAT(mesh, HasSubstr("f v0 v1 v2\nf v2 v3 v0\n"));
}

TEST(WriteMgf, MapsThatKeepAnglesAreAppliedToTheNumbers) {
  const Affine map = Affine::translate({1, 0, 0}) * Affine::scale({2, 2, -2});
  EXPECT_EQ(surfaces(std::make_shared<Instance>(std::make_shared<Sphere>(Vec3{0, 0, 1}, 0.5), map)),
            "v v0 =\n\tp 1 0 -2\nsph v0 1\n");
  // A mirrored disk faces to the mirrored side.
  EXPECT_THAT(
      surfaces(std::make_shared<Instance>(std::make_shared<Disk>(Vec3{}, Vec3{0, 0, 1}, 0.5), map)),
      HasSubstr("n 0 0 -1\nring v0 0 1\n"));
  // The face does too: its corners run the other way.
  EXPECT_THAT(surfaces(std::make_shared<Instance>(
                  std::make_shared<Parallelogram>(Vec3{}, Vec3{2, 0, 0}, Vec3{0, 1, 0}), map)),
              HasSubstr("f v3 v2 v1 v0\n"));
}

TEST(WriteMgf, WhatMgfLacksBecomesTrianglesWithANote) {
  const auto egg =
      std::make_shared<Instance>(std::make_shared<Sphere>(Vec3{}, 1), Affine::scale({1, 1, 2}));
  const WrittenScene written = write_mgf(one_object(egg));
  EXPECT_GT(count(written.text, "\nf "), 500u);
  EXPECT_THAT(written.notes, ElementsAre(HasSubstr("'thing'")));

  std::vector<Vec3> circle;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000;
    circle.push_back({std::cos(angle), std::sin(angle), 0});
  }
  const std::string text = write_mgf(one_object(std::make_shared<Polygon>(circle))).text;
  std::size_t longest = 0;
  for (std::size_t i = 0, end; i < text.size(); i = end + 1) {
    end = text.find('\n', i);
    longest = std::max(longest, end - i);
  }
  EXPECT_LE(longest, 4096u);
}

TEST(WriteMgf, LightIsExitanceWithItsColour) {
  Scene scene = one_object(std::make_shared<Disk>(Vec3{}, Vec3{0, 0, -1}, 0.5));
  scene.objects[0].sides = Sides::front;
  scene.objects[0].exitance = gray(1500);
  scene.objects.push_back(scene.objects[0]);
  scene.objects[1].exitance = {1000, 0, 0};
  const WrittenScene written = write_mgf(scene);
  EXPECT_THAT(written.text, HasSubstr("m gray =\n\tsides 1\n\tc\n\trd 0.5\n\tc\n\ted 1500\n"));
  // The red primary of Rec. 709, adapted to equal-energy white, with its share of the luminance.
  EXPECT_THAT(written.text, HasSubstr("m gray_2 =\n\tsides 1\n\tc\n\trd 0.5\n\tc\n\t\tcxy 0.646"));
  EXPECT_THAT(written.text, HasSubstr("\ted 212.6"));
  EXPECT_THAT(written.notes, ElementsAre(HasSubstr("one-sided")));
}

TEST(WriteMgf, SidesAreThoseOfTheMaterial) {
  Scene scene = one_object(std::make_shared<Parallelogram>(Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}));
  EXPECT_THAT(write_mgf(scene).text, StartsWith("m gray =\n\tsides 2\n"));
  EXPECT_THAT(write_mgf(scene).notes, IsEmpty());
  scene.objects[0].sides = Sides::front;
  EXPECT_THAT(write_mgf(scene).text, StartsWith("m gray =\n\tsides 1\n"));
  scene.cameras = {{"eye", {}, {1, 0, 0}}};
  EXPECT_THAT(write_mgf(scene).notes,
              ElementsAre("cameras are left out (1): MGF has none", HasSubstr("unseen")));
}

TEST(WriteMgf, PartsOfASolidKeepTheirMaterials) {
  const Scene scene = read_scene(
      "isolux: 1\nmaterials: {a: {reflectance: 0.3}, b: {reflectance: 0.6}}\nobjects:\n"
      "  - material: a\n    shape: {difference: [{box: {lower: [0, 0, 0], upper: [2, 2, 2]}}, "
      "{box: {lower: [0.5, 0.5, 1], upper: [1.5, 1.5, 3]}, material: b}]}\n",
      "test.yaml");
  const Scene back = parse_mgf(write_mgf(scene).text, "test.mgf").scene;
  double areas[2] = {};
  for (std::uint32_t i = 0; i < back.objects.size(); ++i) {
    areas[back.material_of(i).name == "b"] += back.objects[i].shape->area().value();
  }
  EXPECT_NEAR(areas[0], 23, 0.5);
  EXPECT_NEAR(areas[1], 5, 0.3);
}

TEST(WriteMgf, TheSkyIsNoted) {
  Scene scene = one_object(std::make_shared<Sphere>(Vec3{}, 1));
  scene.sky.emplace().zenith = gray(1);
  EXPECT_THAT(write_mgf(scene).notes, ElementsAre("the sky is left out: MGF has none"));
}

}  // namespace
}  // namespace isolux
