#include <gmock/gmock.h>

#include <numbers>

#include "formats/radiance_text.h"
#include "formats/temporary_folder.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/shape_description.h"

namespace isolux {
namespace {
using std::numbers::pi;
using testing::ElementsAre;
using testing::HasSubstr;

std::size_t count(const std::vector<Object>& objects, std::string_view kind) {
  return std::count_if(objects.begin(), objects.end(),
                       [&](const Object& o) { return o.shape->describe().kind == kind; });
}

/// What a scene with these files beside it has.
std::vector<Object> objects_with(const std::vector<std::pair<std::string, std::string>>& files,
                                 const std::string& text) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : files) folder.write(name, content);
  return read_radiance(folder.write("main.rad", kGray + text)).scene.objects;
}

TEST(RadianceCommand, Boxes) {
  const auto box = gray_objects("!genbox m crate 1 2 3\n");
  EXPECT_EQ(box.size(), 6u);
  EXPECT_EQ(box[0].name, "crate");
  EXPECT_NEAR(volume_of(box), 6, 1e-12);
  expect_near(bounds_of(box).upper, {1, 2, 3});
  EXPECT_NEAR(volume_of(gray_objects("!genbox m room 1 2 3 -i\n")), -6, 1e-12);
}

TEST(RadianceCommand, BeveledBoxesAreClosed) {
  const auto box = gray_objects("!genbox m crate 2 3 4 -b .25\n");
  EXPECT_EQ(box.size(), 6u + 12 + 8);
  // Edges lose half of b² along their straight part, corners what is left of b³ but a sixth.
  const double b = 0.25, lengths = 4 * (2 + 3 + 4 - 3 * 2 * b);
  EXPECT_NEAR(volume_of(box), 24 - lengths * b * b / 2 - 8 * b * b * b * 5 / 6, 1e-12);
  EXPECT_NEAR(volume_of(gray_objects("!genbox m crate 2 3 4 -i -b .25\n")), -volume_of(box), 1e-12);
}

TEST(RadianceCommand, RoundedBoxesAreRound) {
  const auto box = gray_objects("!genbox m crate 2 3 4 -r .25\n");
  EXPECT_EQ(count(box, "sphere"), 8u);
  EXPECT_EQ(count(box, "cylinder"), 12u);
  EXPECT_EQ(box.size(), 26u);
  const double round = 12 * 2 * pi * 0.25 * (4.0 * (1.5 + 2.5 + 3.5) / 12) + 8 * pi * 0.25;
  EXPECT_NEAR(total_area(box), 2 * (1.5 * 2.5 + 1.5 * 3.5 + 2.5 * 3.5) + round, 1e-9);
  expect_near(bounds_of(box).lower, {});
  expect_near(bounds_of(box).upper, {2, 3, 4});
}

TEST(RadianceCommand, RoundedRoomsStaySharp) {
  const SceneFile file = read_radiance_text(kGray + "!genbox m room 2 3 4 -r .25 -i\n");
  EXPECT_NEAR(volume_of(file.scene.objects), -24, 1e-12);
  EXPECT_THAT(file.notes, ElementsAre(HasSubstr("stay sharp")));
}

TEST(RadianceCommand, Prisms) {
  const auto prism = gray_objects("!genprism m p 3  0 0  0 1  1 0  -l 0 0 2\n");
  EXPECT_EQ(prism.size(), 5u);
  EXPECT_NEAR(volume_of(prism), 1, 1e-12);
  // Its corners run the other way, but so does its height.
  EXPECT_NEAR(volume_of(gray_objects("!genprism m p 3  0 0  1 0  0 1  -l 0 0 -2\n")), 1, 1e-12);
  EXPECT_EQ(gray_objects("!genprism m p 3  0 0  0 1  1 0  -e\n").size(), 3u);
  EXPECT_EQ(gray_objects("!genprism m p 3  0 0  0 1  1 0  -c\n").size(), 4u);
  EXPECT_NEAR(volume_of(objects_with({{"corners", "0 0\n0 1\n1 1\n1 0\n"}},
                                     "!genprism m p corners -l 1 1 3\n")),
              3, 1e-12);
}

// Rounded by r, a square prism is a rounded box: whatever its lean, its flat sides touch the balls.
TEST(RadianceCommand, RoundedPrisms) {
  const auto prism = gray_objects("!genprism m p 4  0 0  0 3  2 3  2 0  -l 0 0 4 -r .25\n");
  const auto box = gray_objects("!genbox m crate 2 3 4 -r .25\n");
  EXPECT_EQ(count(prism, "sphere"), 8u);
  EXPECT_EQ(count(prism, "cylinder"), 12u);
  EXPECT_NEAR(total_area(prism), total_area(box), 1e-9);
  expect_near(bounds_of(prism).lower, bounds_of(box).lower, 1e-9);
  expect_near(bounds_of(prism).upper, bounds_of(box).upper, 1e-9);
  const auto leaning = gray_objects("!genprism m p 4  0 0  0 3  2 3  2 0  -l 1 .5 4 -r .25\n");
  std::vector<Vec3> centers;
  for (const Object& o : leaning) {
    if (o.shape->solid()) centers.push_back(o.shape->bounds().center());
  }
  for (const Object& o : leaning) {
    if (o.shape->describe().kind == "cylinder" || o.shape->solid()) continue;
    const TriangleSoup soup = o.shape->triangulate(100).value();
    const auto& [a, b, c] = soup.triangles[0];
    const Vec3 normal =
        normalized(cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]));
    std::size_t touching = 0;
    for (const Vec3& center : centers) {
      const double depth = dot(normal, soup.points[a] - center);
      EXPECT_GT(depth, 0.25 - 1e-9);
      touching += depth < 0.25 + 1e-9;
    }
    EXPECT_EQ(touching, 4u);
  }
}

TEST(RadianceCommand, Blinds) {
  const auto flat = gray_objects("!genblinds m b 1 4 12 6 30\n");
  EXPECT_EQ(flat.size(), 6u);
  EXPECT_NEAR(total_area(flat), 6 * 4, 1e-12);
  expect_near(bounds_of(flat).lower, {0, 0, 1});
  expect_near(bounds_of(flat).upper, {std::cos(pi / 6), 4, 11.5});
  // A quarter of a circle, in strips of 3 degrees; it hangs below its chord, or rises above.
  const auto hanging = gray_objects("!genblinds m b 1.414213562373095 1 2 1 0 -r 1\n");
  EXPECT_EQ(hanging.size(), 30u);
  EXPECT_NEAR(total_area(hanging), pi / 2, 1e-3);
  expect_near(bounds_of(hanging).lower, {0, 0, 1 - (1 - std::sqrt(0.5))}, 1e-6);
  expect_near(bounds_of(gray_objects("!genblinds m b 1.414213562373095 1 2 1 0 +r 1\n")).upper,
              {std::sqrt(2), 1, 1 + (1 - std::sqrt(0.5))}, 1e-6);
}

TEST(RadianceCommand, Revolutions) {
  // A half circle turned about z; its 40 cones have almost the area of the ball.
  const auto ball = gray_objects("!genrev m b '-cos(PI*t)' 'sin(PI*t)' 40\n");
  EXPECT_EQ(ball.size(), 40u);
  EXPECT_NEAR(total_area(ball), 4 * pi, 0.02);
  // Up along a cylinder, inward over a ring and down a tube.
  const auto cup =
      gray_objects("!genrev m cup 'if(t-.4,if(t-.9,0,2),if(t-.1,2,0))' 'if(t-.6,1,2)' 3 -s\n");
  ASSERT_EQ(cup.size(), 3u);
  EXPECT_EQ(cup[0].shape->describe().kind, "cylinder");
  EXPECT_EQ(cup[1].shape->describe().kind, "disk");
  EXPECT_EQ(cup[2].shape->describe().kind, "reversed");
  EXPECT_GT(hits_along(*cup[1].shape, {1.5, 0, 5}, {0, 0, -1}).at(0).normal.z, 0);
}

TEST(RadianceCommand, Worms) {
  const auto straight = gray_objects("!genworm m w '4*t' 0 0 1 4\n");
  EXPECT_EQ(count(straight, "sphere"), 5u);
  EXPECT_EQ(count(straight, "cylinder"), 4u);
  // A cone that touches a ball of radius 3 and one of radius 1 at a distance of 4.
  const auto tapering = gray_objects("!genworm m w '4*t' 0 0 '3-2*t' 1\n");
  ASSERT_EQ(count(tapering, "cone"), 1u);
  for (const Object& o : tapering) {
    const ShapeDescription shape = o.shape->describe();
    const auto* const radii = shape.find<std::vector<double>>("radii");
    if (!radii) continue;
    EXPECT_NEAR((*radii)[0], 3 * std::sqrt(0.75), 1e-12);
    EXPECT_NEAR((*radii)[1], 1 * std::sqrt(0.75), 1e-12);
    expect_near(*shape.find<Vec3>("from"), {1.5, 0, 0});
    expect_near(*shape.find<Vec3>("to"), {4.5, 0, 0});
  }
}

TEST(RadianceCommand, Surfaces) {
  const auto sheet = gray_objects("!gensurf m s '2*s' '3*t' 5 4 6\n");
  ASSERT_EQ(sheet.size(), 1u);
  EXPECT_NEAR(total_area(sheet), 6, 1e-12);
  EXPECT_GT(hits_along(*sheet[0].shape, {1.1, 1.1, 9}, {0, 0, -1}).at(0).normal.z, 0);
  const auto ball = gray_objects(
      "!gensurf m s 'sin(PI*s)*cos(2*PI*t)' 'sin(PI*s)*sin(2*PI*t)' 'cos(PI*s)' 30 60 -s\n");
  EXPECT_NEAR(volume_of(ball), 4 * pi / 3, 0.03);
  EXPECT_NEAR(volume_of(gray_objects("!gensurf m s 'sin(PI*s)*cos(2*PI*t)' "
                                     "'sin(PI*s)*sin(2*PI*t)' 'cos(PI*s)' 30 60 -i\n")),
              -volume_of(ball), 1e-9);
}

TEST(RadianceCommand, Expressions) {
  const auto value = [](const std::string& expression) {
    return gray_objects("!genworm m w '" + expression + "' 0 0 1 1\n")[0]
        .shape->bounds()
        .center()
        .x;
  };
  const std::pair<const char*, double> cases[] = {
      {"1+2*3", 7},
      {"2^3^2", 512},
      {"-2^2", 4},  // a sign belongs to its number
      {"8/4/2", 1},
      {"7-4-2", 1},
      {"(1+2)*3", 9},
      {".5e1", 5},
      {"sqrt(16)", 4},
      {"if(t-1,5,6)", 6},
      {"atan2(1,1)*4", pi},
      {"hermite(1,9,0,0,0)", 1},
      {"hermite(1,9,2,0,.5)", 5.25},
      {"bezier(1,3,3,1,.5)", 2.5},
      {"bspline(6,6,6,6,.3)", 6},
      {" max( 1 , min(2,3) ) ", 2},
      {"floor(-1.5)", -2},
      {"log10(100)+exp(0)", 3},
  };
  for (const auto& [expression, expected] : cases) {
    EXPECT_NEAR(value(expression), expected, 1e-12) << expression;
  }
}

TEST(RadianceCommand, XformMovesFilesAndPipes) {
  const std::string ball = "m sphere ball\n0\n0\n4 1 0 0 .5\n";
  const auto center = [&](const std::string& xform) {
    return objects_with({{"ball", ball}}, xform)[0].shape->bounds().center();
  };
  expect_near(center("!xform -t 1 2 3 ball\n"), {2, 2, 3});
  expect_near(center("!xform -rz 90 ball\n"), {0, 1, 0});
  expect_near(center("!xform -rz 90 -t 1 0 0 ball\n"), {1, 1, 0});
  expect_near(center("!xform -t 1 0 0 -rz 90 ball\n"), {0, 2, 0});
  expect_near(center("!xform -s 2 -mx ball\n"), {-2, 0, 0});
  expect_near(center("!xform -i 3 -rz 30 ball\n"), {0, 1, 0});
  expect_near(center("!cat ball | xform -t 1 0 0 | xform -rz 90\n"), {0, 2, 0});
  expect_near(center("!xform -t 1 0 0 \\\n  ball\n"), {2, 0, 0});
  EXPECT_NEAR(objects_with({{"ball", ball}}, "!xform -s 3 ball\n")[0].shape->bounds().upper.z, 1.5,
              1e-12);
}

TEST(RadianceCommand, XformNamesReplacesAndTurnsOver) {
  const std::string ball = "other sphere ball\n0\n0\n4 0 0 0 1\n";
  const auto objects =
      objects_with({{"ball", ball}}, "!xform -n a -n b -m m -I -t 1 0 0 ball ball\n");
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].name, "a.b.ball");
  EXPECT_EQ(objects[1].name, "a.b.ball 2");
  EXPECT_LT(hits_along(*objects[0].shape, {1, 0, 0}, {1, 0, 0})[1].normal.x, 0);
  const SceneFile file = read_radiance_text(kGray + "!genbox other b 1 1 1 | xform -m m\n");
  EXPECT_TRUE(file.notes.empty()) << "the material of the pipe's end counts";
  EXPECT_EQ(file.scene.material_of(0).name, "m");
}

TEST(RadianceCommand, ArraysNest) {
  const auto objects =
      gray_objects("!genbox m b 1 1 1 | xform -a 3 -t 2 0 0 -a 4 -t 0 2 0 -i 1 -s 2\n");
  EXPECT_EQ(objects.size(), 6u * 12);
  EXPECT_NEAR(volume_of(objects), 12 * 8, 1e-9);
  expect_near(bounds_of(objects).upper, {10, 14, 2});
}

TEST(RadianceCommand, MirrorsKeepOutwardOutward) {
  EXPECT_NEAR(volume_of(gray_objects("!genbox m b 1 2 3 | xform -mx -my -mz -rx 30\n")), 6, 1e-12);
  EXPECT_NEAR(volume_of(gray_objects("!gensurf m s 'sin(PI*s)*cos(2*PI*t)' 'sin(PI*s)*sin(2*PI*t)' "
                                     "'cos(PI*s)' 8 8 | xform -mz\n")),
              volume_of(gray_objects("!gensurf m s 'sin(PI*s)*cos(2*PI*t)' 'sin(PI*s)*sin(2*PI*t)' "
                                     "'cos(PI*s)' 8 8\n")),
              1e-12);
}

// Names are relative to the scene's folder, wherever the file that has them stands.
TEST(RadianceCommand, FilesNest) {
  const auto objects = objects_with({{"parts/table", "!xform -n leg -a 4 -t 1 0 0 parts/leg\n"},
                                     {"parts/leg", "!genbox m b .1 .1 1\n"}},
                                    "!xform -n table -t 0 0 1 parts/table\n");
  EXPECT_EQ(objects.size(), 24u);
  EXPECT_EQ(objects[0].name, "table.leg.b");
  expect_near(bounds_of(objects).upper, {3.1, 0.1, 2});
}

TEST(RadianceCommand, InstancesReadTheDescriptionBesideTheOctree) {
  const auto objects = objects_with({{"tree.rad", "!genbox other b 1 1 1\n"}},
                                    "m instance tree\n5 tree.oct -t 5 0 0\n0\n0\n");
  ASSERT_EQ(objects.size(), 6u);
  EXPECT_EQ(objects[0].name, "tree.b");
  expect_near(bounds_of(objects).lower, {5, 0, 0});
}

TEST(RadianceCommand, MeshesReadTheObjBesideThem) {
  const std::string tetrahedron =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
  const auto objects = objects_with(
      {{"rock.obj", tetrahedron}},
      "m mesh a 1 rock.rtm 0 0\nm mesh b 7 rock.rtm -t 5 0 0 -s 2 0 0\n"
      "void light l 0 0 3 1 1 1\nl mesh c 1 rock.rtm 0 0\nm mesh d 3 rock.rtm -a 3 0 0\n");
  ASSERT_EQ(objects.size(), 6u);
  EXPECT_EQ(objects[1].name, "b");
  EXPECT_TRUE(objects[1].shape->solid());
  EXPECT_EQ(objects[1].sides, Sides::front);
  EXPECT_NEAR(volume_of({objects[0]}), 1.0 / 6, 1e-12);
  EXPECT_NEAR(volume_of({objects[1]}), 8.0 / 6, 1e-12);
  expect_near(objects[1].shape->bounds().upper, {12, 2, 2});
  for (const std::size_t i : {1u, 3u, 4u, 5u}) {
    EXPECT_EQ(original(objects[i].shape).shape, objects[0].shape);
  }
  EXPECT_TRUE(objects[2].emits());  // the winding of lights is theirs: here they don't agree
  EXPECT_FALSE(objects[2].shape->solid());
}

TEST(RadianceCommand, FaultsOfAMeshAreInItsFile) {
  try {
    objects_with({{"a.obj", "v 0 0\n"}}, "m mesh a 1 a.rtm 0 0\n");
    FAIL() << "a vertex of two numbers was read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/a.obj:1:1: "));
  }
  EXPECT_THAT(read_radiance_text(kGray + "void mesh a 1 a.rtm 0 0\n!genbox m b 1 1 1\n").notes,
              ElementsAre("'mesh' left out: without a modifier, the materials in its file are "
                          "not read"));
}

TEST(RadianceCommand, UnknownOnesAreLeftOut) {
  const SceneFile file = read_radiance_text(kGray +
                                            "!gendaylit 6 21 12 -W 800 100 | xform -rz 30\n"
                                            "!rm -r /\n"
                                            "!genbox m a 1 1 1 > b.rad\n"
                                            "!gensurf m a 'noise3(s)' s t 2 2\n"
                                            "!gensurf m a s s t 2 2 -e 'x=1'\n"
                                            "!genbox m b 1 1 1 | getinfo\n"
                                            "!genbox m c 1 1 1\n");
  EXPECT_EQ(file.scene.objects.size(), 6u);
  EXPECT_THAT(
      file.notes,
      ElementsAre("command 'gendaylit' left out: that program is not known, but what it writes is: "
                  "put that in its place",
                  "command 'rm' left out: that program is not known",
                  "command 'genbox' left out: it is written for a shell",
                  "command 'gensurf' left out: the function 'noise3' is not known",
                  "command 'gensurf' left out: the option '-e' is not known",
                  "command 'getinfo' left out: that program is not known"));
}

}  // namespace
}  // namespace isolux
