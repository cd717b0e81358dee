// CSG: what is inside, by volumes and by points.
#include <gtest/gtest.h>

#include <numbers>

#include "formats/rayshade_text.h"
#include "isolux/core/random.h"

namespace isolux {
namespace {

using std::numbers::pi;

/// Volume by counting points in the bounds; its standard error is below 0.002 of theirs.
double volume(const Shape& solid) {
  constexpr int kCount = 100'000;
  const Bounds box = solid.bounds();
  const Vec3 size = box.upper - box.lower;
  Random random(1);
  int within = 0;
  for (int i = 0; i < kCount; ++i) {
    const Vec3 u{random.uniform(), random.uniform(), random.uniform()};
    within += solid.contains(box.lower + Vec3{u.x * size.x, u.y * size.y, u.z * size.z});
  }
  return size.x * size.y * size.z * within / kCount;
}

TEST(RayshadeSolids, VolumesAreThoseOfTheirFormulas) {
  struct Case {
    const char* text;
    double volume;
  };
  const Case cases[] = {
      {"difference box -1 -1 -1 1 1 1 cylinder .5 0 0 -2 0 0 2 end", 8 - pi / 2},
      {"intersect box 0 0 0 2 2 2 sphere 1 0 0 0 end", pi / 6},
      // Two balls of radius 1, their centres 1 apart, share 5 π / 12.
      {"union sphere 1 0 0 0 sphere 1 1 0 0 end", 8 * pi / 3 - 5 * pi / 12},
      {"union box 0 0 0 1 1 1 box 2 0 0 3 1 1 box 4 0 0 5 1 1 end", 3},
      {"difference box 0 0 0 3 1 1 box -1 -1 -1 1 2 2 box 2 -1 -1 4 2 2 end", 1},
      // A cone of heights 2 and 4 less a cylinder in its list, caps and all.
      {"union list cone 2 0 0 0 1 0 0 2 disc 2 0 0 0 0 0 -1 disc 1 0 0 2 0 0 1 end\n"
       "  list cylinder 1 0 0 1 0 0 4 disc 1 0 0 1 0 0 -1 disc 1 0 0 4 0 0 1 end end",
       14 * pi / 3 + 2 * pi},
      // Of the ball what lies behind the plane, whose normal points out.
      {"intersect sphere 1 0 0 0 plane 0 0 0 0 0 1 end", 2 * pi / 3},
      {"difference sphere 1 0 0 0 plane 0 0 .5 0 1 1 translate 0 0 -.5 end", 2 * pi / 3},
      // A tetrahedron of triangles and a polygon.
      {"difference list triangle 0 0 0 0 1 0 1 0 0 triangle 0 0 0 1 0 0 0 0 1\n"
       "  triangle 0 0 0 0 0 1 0 1 0 poly 1 0 0 0 1 0 0 0 1 end box 3 0 0 4 1 1 end",
       1.0 / 6},
      {"name ball sphere 1 0 0 0\n"
       "difference object ball scale 2 2 2 object ball translate 1 0 0 end scale 1 1 2",
       2 * (32 * pi / 3 - 4 * pi / 3)},
      {"union blob .25 1 1 0 0 0 box 2 0 0 3 1 1 end",
       1 + 4 * pi / 3 * std::pow(1 - std::sqrt(.25), 1.5)},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const auto solid = rayshade_shape(c.text);
    ASSERT_TRUE(solid->solid());
    const Vec3 size = solid->bounds().upper - solid->bounds().lower;
    EXPECT_NEAR(volume(*solid), c.volume, 0.008 * size.x * size.y * size.z);
  }
}

TEST(RayshadeSolids, OpenCylindersOfAListGetCapsFromItsDiscs) {
  const auto solid = rayshade_shape(
      "union list cylinder 1 0 0 0 0 0 2 disc 1 0 0 0 0 0 -1 disc 1 0 0 2 0 0 1 end\n"
      "sphere .5 5 0 0 end");
  Hits hits;
  solid->intersect({{0.3, 0, -5}, {0, 0, 1}}, hits);
  ASSERT_EQ(hits.size(), 2u) << "the caps are there once";
  EXPECT_NEAR(hits[0].t, 5, 1e-12);
  EXPECT_NEAR(hits[1].t, 7, 1e-12);
}

TEST(RayshadeSolids, OutsideCsgCylindersStayOpen) {
  const Scene scene = rayshade_scene("list cylinder 1 0 0 0 0 0 2 disc 1 0 0 0 0 0 -1 end");
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_FALSE(scene.objects[0].shape->solid());
  EXPECT_EQ(scene.objects[0].sides, Sides::both);
}

TEST(RayshadeSolids, GroundWithADent) {
  const Scene scene = rayshade_scene("difference plane 0 0 0 0 0 1 sphere 1 0 0 0 end");
  const Shape& ground = *scene.objects[0].shape;
  EXPECT_TRUE(ground.contains({2, 0, -0.1}));
  EXPECT_FALSE(ground.contains({2, 0, 0.1}));
  EXPECT_FALSE(ground.contains({0, 0, -0.9}));
  EXPECT_TRUE(ground.contains({0, 0, -1.1}));
}

TEST(RayshadeSolids, PartsKeepTheirSurfaces) {
  const std::string surfaces = "surface red diffuse .5 0 0 surface blue diffuse 0 0 .5\n";
  const Scene scene = rayshade_scene(
      surfaces +
      "name hole list sphere blue 1 0 0 0 box blue -1 -1 1 1 1 2 end\n"
      "difference box red -2 -2 -2 2 2 2 object hole translate 2 0 0 sphere red 1 0 -2 0 end");
  ASSERT_EQ(scene.objects.size(), 2u);
  // What lies towards the middle from there, and its color.
  const auto looks = [&](const Vec3& from) {
    for (std::uint32_t i = 0; i < 2; ++i) {
      Hits hits;
      scene.objects[i].shape->intersect({from, -from}, hits);
      if (!hits.empty() && hits.front().t < 0.9) return scene.material_of(i).name;
    }
    return std::string("nothing");
  };
  EXPECT_EQ(looks({5, 0, 0}), "blue");
  EXPECT_EQ(looks({-5, 0, 0}), "red");
  EXPECT_EQ(looks({0, -5, 0}), "red");
  EXPECT_EQ(scene.materials.size(), 2u);
}

}  // namespace
}  // namespace isolux
