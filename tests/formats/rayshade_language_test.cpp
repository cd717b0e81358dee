// Numbers, expressions, macros, includes, the view.
#include <gtest/gtest.h>

#include <numbers>

#include "formats/rayshade_text.h"

namespace isolux {
namespace {

using std::numbers::pi;

/// What a number comes to: it is used as the radius of a sphere.
double value(const std::string& number, const std::string& before = "") {
  const auto sphere = rayshade_shape(before + "\nsphere " + number + " 0 0 0\n");
  return sphere->bounds().upper.x;
}

TEST(RayshadeLanguage, Numbers) {
  EXPECT_EQ(value("2"), 2);
  EXPECT_EQ(value("2."), 2);
  EXPECT_EQ(value(".5"), 0.5);
  EXPECT_EQ(value("+1.5e-2"), 0.015);
  EXPECT_EQ(value("(3)"), 3);
}

TEST(RayshadeLanguage, Expressions) {
  EXPECT_EQ(value("(1 + 2 * 3)"), 7);
  EXPECT_EQ(value("((1 + 2) * 3)"), 9);
  EXPECT_EQ(value("(10-4-3)"), 3);
  EXPECT_EQ(value("(2^3^2)"), 512);
  EXPECT_EQ(value("(6-(-2^2))"), 10) << "a power binds more tightly than a sign";
  EXPECT_EQ(value("(2^-1)"), 0.5);
  EXPECT_EQ(value("(17 % 5)"), 2);
  EXPECT_EQ(value("(7.9 % 3)"), 1) << "of whole numbers";
  EXPECT_EQ(value("-(-3)"), 3);
  EXPECT_NEAR(value("(sin(pi / 6))"), 0.5, 1e-15);
  EXPECT_NEAR(value("(cos(60*dtor))"), 0.5, 1e-15) << "angles in radians";
  EXPECT_NEAR(value("(rtod*atan(1))"), 45, 1e-13);
  EXPECT_EQ(value("(hypot(3, 4))"), 5);
  EXPECT_EQ(value("(sqrt(16) + time + frame)"), 4);
  EXPECT_EQ(value("(linear(0, 2, 10, 4))"), 2) << "at the start";
  EXPECT_EQ(value("(linear(0, 2, 10, 4))", "starttime 5"), 3);
}

TEST(RayshadeLanguage, Variables) {
  EXPECT_EQ(value("(2*r)", "define r 3"), 6);
  EXPECT_EQ(value("(b-a)", "define a 1\ndefine b (a+4)"), 4) << "words end at a sign";
}

TEST(RayshadeLanguage, Macros) {
  EXPECT_EQ(value("R", "#define R 4"), 4);
  EXPECT_EQ(value("TWICE(R)", "#define TWICE(x) (2*(x))\n#define R 1+2"), 6);
  EXPECT_EQ(value("ADD(1, MUL(2,\n3))", "#define ADD(a,b) (a+b)\n#define MUL( a , b ) (a*b)"), 7);
  EXPECT_EQ(value("F(F(2))", "#define F(x) (x*x)"), 16);
  EXPECT_EQ(value("R", "#define R \\\n  5 /* five */"), 5);
  EXPECT_EQ(value("1e0", "#define e 7\n#define e0 8"), 1) << "no macro within a number";
  const Scene scene = rayshade_scene("#define EXPAND(x) scale x x x\nsphere 1 0 0 0 EXPAND(3)\n");
  EXPECT_NEAR(scene.objects[0].shape->bounds().upper.z, 3, 1e-14);
}

TEST(RayshadeLanguage, AMacroIsNotExpandedWithinItself) {
  EXPECT_EQ(value("(r)", "define r 2\n#define r r"), 2);
}

TEST(RayshadeLanguage, Conditions) {
  const std::string text =
      "#ifdef BIG\n#define R 9\n#else\n#define R 2\n#endif\n"
      "#ifndef R\n this is not read $\n#if 1\n#endif\n#endif\n"
      "#if 0\nsphere\n#else\n#undef BIG\n#endif";
  EXPECT_EQ(value("R", text), 2);
  EXPECT_EQ(value("R", "#define BIG\n" + text), 9);
}

TEST(RayshadeLanguage, Comments) {
  EXPECT_EQ(value("/* a radius\n of */ 3"), 3);
  EXPECT_EQ(value("3/**/"), 3);
}

TEST(RayshadeLanguage, Includes) {
  write_scene("#define R 6\nname ball sphere R 0 0 0\n", "ball.def.ray");
  const Scene scene = rayshade_scene("#include \"ball.def.ray\"\nobject ball\n");
  EXPECT_EQ(scene.objects[0].name, "ball");
  EXPECT_EQ(scene.objects[0].shape->bounds().upper.x, 6);
}

TEST(RayshadeLanguage, TheView) {
  const Scene scene = rayshade_scene(
      "sphere 1 0 0 0 eyep 1 2 3 translate 1 0 0 lookp 0 1 0 up 0 1 0 fov 60 screen 200 100");
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "default");
  expect_near(camera.eye, {2, 2, 3});
  expect_near(camera.look_at, {0, 1, 0});
  expect_near(camera.up, {0, 1, 0});
  EXPECT_EQ(camera.width, 200);
  EXPECT_EQ(camera.height, 100);
  // The given angle is that of the width: the ray to the middle of the right edge is 30° off.
  const Vec3 right = camera.ray(1, 0.5).direction, middle = camera.ray(0.5, 0.5).direction;
  EXPECT_NEAR(angle_between(right, middle), pi / 6, 1e-12);
}

TEST(RayshadeLanguage, TheViewWhereNoneIsGiven) {
  const Camera camera = rayshade_scene("sphere 1 0 0 0").cameras[0];
  expect_near(camera.eye, {0, -10, 0});
  expect_near(camera.look_at, {});
  expect_near(camera.up, {0, 0, 1});
  EXPECT_NEAR(camera.fov, 45, 1e-12);
  EXPECT_EQ(camera.width, 512);
  EXPECT_NEAR(rayshade_scene("sphere 1 0 0 0 fov 40 30").cameras[0].fov, 30, 1e-12);
}

TEST(RayshadeLanguage, WhatIsLeftOutIsNamedOnce) {
  const SceneFile file = read_rayshade_text(
      "sample 3 jitter maxdepth 4 cutoff .1 cutoff .1 .1 .1 contrast .1 .1 .1 shadowtransp\n"
      "filter gauss 2 report verbose quiet 5 stats.txt outfile a.rle background 1 1 1\n"
      "aperture .1 focaldist 3 eyesep 1 window 0 9 0 9 crop 0 1 0 1 frames 3 shutter .5\n"
      "framelength 1 print (1+1) atmosphere 1.1 fog 1 1 1 2 2 2 mist 1 1 1 1 1 1 2 3\n"
      "surface s ambient 1 1 1 diffuse .5 .5 .5 specular 1 1 1 specpow 4 body 1 1 1\n"
      "  extinct .5 transp .2 reflect .1 index 1.2 translucency .1 1 1 1 3 noshadow\n"
      "light 1 ambient light 1 point 5 5 5 noshadow\n"
      "sphere s 1 0 0 0 texture checker s scale 2 2 2 texture blotch .3 s texture bump .3\n"
      "  texture marble rotate 0 0 1 4 texture marble a.map texture fbm 1 1 1 1 1 1 b.map\n"
      "  texture fbmbump 1 1 1 1 1 texture wood texture gloss .2 texture cloud 1 1 1 1 1 1 1\n"
      "  texture sky 1 1 1 1 1 1 texture windy 1 1 1 1 1 1 1 1 texture mount a.file 1 1\n"
      "  texture stripe s .1 3 map planar 0 0 0 0 0 1 1 0 0\n"
      "  texture image ../a-b.rle component diffuse tile 2 2 textsurf s range 0 1 smooth map uv\n"
      "sphere s 1 5 0 0 texture wood\n");
  EXPECT_EQ(file.scene.objects.size(), 2u);
  std::size_t textures = 0;
  for (const std::string& note : file.notes) {
    textures += note.find("'texture'") != std::string::npos;
    EXPECT_EQ(note.find('\n'), std::string::npos);
  }
  EXPECT_EQ(textures, 1u);
  for (const char* word : {"'sample'", "'shadowtransp'", "'aperture'", "'frames'", "'atmosphere'",
                           "'background'", "'specular'", "'transp'", "'ambient'", "'noshadow'"}) {
    EXPECT_TRUE(has_note(file, word)) << word;
  }
}

}  // namespace
}  // namespace isolux
