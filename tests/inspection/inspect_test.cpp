#include "isolux/inspection/inspect.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <chrono>

#include "isolux/core/parallel.h"
#include "isolux/formats/scene_file.h"
#include "isolux/inspection/surface_points.h"
#include "support/scenes.h"
#include "support/tessellated.h"

namespace isolux {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kMaterials = "materials: {m: {reflectance: 0.5}, black: {reflectance: 0}}\n";

/// A closed room, 4 m × 4 m × 3 m, with a lamp under its ceiling and a camera in it.
const std::string kRoom = kMaterials + R"(
cameras: {eye: {eye: [0.5, 0.5, 1.7], look_at: [3, 3, 1]}}
objects:
  - {name: room, shape: {box: {lower: [0, 0, 0], upper: [4, 4, 3], inward: true}}, material: m}
  - name: lamp
    shape: {parallelogram: {corner: [1, 1, 3], u: [0, 2, 0], v: [2, 0, 0]}}
    material: black
    sides: front
    emission: {flux: 1000}
)";

Inspection inspect(const std::string& yaml) {
  const Scene scene = scene_of(yaml);
  return inspect_scene(RayCaster(scene));
}

Inspection inspect_room_with(const std::string& objects) { return inspect(kRoom + objects); }

std::string object(const std::string& name, const std::string& shape,
                   const std::string& more = "") {
  return fmt::format("  - {{name: {}, shape: {{{}}}, material: m{}}}\n", name, shape, more);
}

std::string box(const std::string& name, const std::string& lower, const std::string& upper) {
  return object(name, fmt::format("box: {{lower: [{}], upper: [{}]}}", lower, upper));
}

std::string sheet(const std::string& name, const std::string& corner, const std::string& u,
                  const std::string& v, const std::string& more = "") {
  return object(
      name, fmt::format("parallelogram: {{corner: [{}], u: [{}], v: [{}]}}", corner, u, v), more);
}

TEST(Inspection, ARoomWithALampInItsCeilingIsWithoutDoubt) {
  const Inspection inspection = inspect_room_with("");
  EXPECT_THAT(inspection.warnings, IsEmpty());
  EXPECT_GT(inspection.rays, 10'000u);
  EXPECT_EQ(inspection.escaped, 0u);
}

TEST(Inspection, ExamplesAreClosedOrOpenAsTheyLook) {
  for (const char* closed : {"lalonde1993/room.yaml", "office/office.yaml"}) {
    const Scene scene = load_scene(source_dir() / "examples" / closed);
    EXPECT_EQ(inspect_scene(RayCaster(scene)).escaped, 0u) << closed;
  }
  const Scene die = load_scene(source_dir() / "examples/csg/die.yaml");
  const Inspection inspection = inspect_scene(RayCaster(die));
  EXPECT_GT(inspection.escaped, 0u);
  EXPECT_THAT(inspection.warnings, IsEmpty());
}

TEST(Inspection, TheShareOfEscapingRaysIsThatOfTheOpening) {
  // From the floor of a cube without ceiling, F = 0.1998 of the light leaves; all of it that
  // comes from above. A lamp that covers the floor, with black walls: one step at most.
  const Inspection inspection = inspect(kMaterials + R"(objects:
  - {shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0]}}, material: black, sides: front, emission: {flux: 1}}
  - {shape: {parallelogram: {corner: [0, 0, 0], u: [1, 0, 0], v: [0, 0, 1]}}, material: m, sides: front}
  - {shape: {parallelogram: {corner: [0, 1, 0], u: [0, 0, 1], v: [1, 0, 0]}}, material: m, sides: front}
  - {shape: {parallelogram: {corner: [0, 0, 0], u: [0, 1, 0], v: [0, 0, 1]}}, material: m, sides: front}
  - {shape: {parallelogram: {corner: [1, 0, 0], u: [0, 0, 1], v: [0, 1, 0]}}, material: m, sides: front}
)");
  EXPECT_NEAR(double(inspection.escaped) / double(inspection.rays), 0.1998, 0.02);
}

TEST(Inspection, WithoutLightEyesAreAsked) {
  const std::string hall =
      kMaterials + "objects:\n" +
      object("hall", "box: {lower: [0, 0, 0], upper: [1, 1, 1], inward: true}");
  EXPECT_EQ(inspect(hall).rays, 0u);
  const Inspection seen =
      inspect(hall + "cameras: {eye: {eye: [0.5, 0.5, 0.5], look_at: [1, 1, 1]}}\n");
  EXPECT_GT(seen.rays, 0u);
  EXPECT_EQ(seen.escaped, 0u);
}

TEST(Inspection, TheSameOnAnyNumberOfThreads) {
  const Scene scene = load_scene(source_dir() / "examples/office/office.yaml");
  std::vector<Inspection> found;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    found.push_back(inspect_scene(RayCaster(scene)));
  }
  EXPECT_EQ(found[0].rays, found[1].rays);
  EXPECT_EQ(found[0].warnings, found[1].warnings);
}

TEST(Inspection, PointsLieOnTheirSurfaces) {
  const Scene scene = scene_of(kRoom + object("ball", "sphere: {center: [2, 2, 1], radius: 0.3}"));
  const auto points = points_on_objects(scene);
  ASSERT_EQ(points.size(), 3u);
  for (const auto& of_one : points) EXPECT_EQ(of_one.size(), 64u);
  for (const Hit& point : points[2]) {
    EXPECT_NEAR(distance(point.point, {2, 2, 1}), 0.3, 1e-9);
  }
}

TEST(Coincident, OneOfTwoAlikeIsHidden) {
  EXPECT_THAT(inspect_room_with(sheet("a", "1, 1, 1", "1, 0, 0", "0, 1, 0") +
                                sheet("b", "1, 1, 1", "1, 0, 0", "0, 1, 0"))
                  .warnings,
              ElementsAre("'a' coincides with 'b', which comes later in the scene and hides it"));
  EXPECT_THAT(inspect_room_with(object("a", "sphere: {center: [1, 1, 1], radius: 0.2}") +
                                object("b", "sphere: {center: [1, 1, 1], radius: 0.2}"))
                  .warnings,
              Contains(HasSubstr("'a' coincides with 'b'")));
}

TEST(Coincident, TwoThatOverlapInAPlane) {
  EXPECT_THAT(inspect_room_with(sheet("a", "1, 1, 1", "1, 0, 0", "0, 1, 0") +
                                sheet("b", "1.5, 1.5, 1", "1, 0, 0", "0, 1, 0"))
                  .warnings,
              ElementsAre("'a' and 'b' overlap in one surface: there, the later in the scene is "
                          "seen"));
}

TEST(Coincident, NearMisses) {
  // Side by side; a hair's breadth apart but not a sixty-thousandth; back to back.
  EXPECT_THAT(inspect_room_with(sheet("a", "1, 1, 1", "1, 0, 0", "0, 1, 0") +
                                sheet("b", "2, 1, 1", "1, 0, 0", "0, 1, 0"))
                  .warnings,
              IsEmpty());
  EXPECT_THAT(inspect_room_with(sheet("a", "1, 1, 1", "1, 0, 0", "0, 1, 0") +
                                sheet("b", "1.5, 1.5, 1.0001", "1, 0, 0", "0, 1, 0"))
                  .warnings,
              IsEmpty());
  EXPECT_THAT(inspect_room_with(sheet("a", "1, 1, 1", "1, 0, 0", "0, 1, 0", ", sides: front") +
                                sheet("b", "1, 1, 1", "0, 1, 0", "1, 0, 0", ", sides: front"))
                  .warnings,
              IsEmpty());
}

TEST(Coincident, WhatStandsHangsOrLiesIsAsItShouldBe) {
  EXPECT_THAT(inspect_room_with(box("cupboard", "0, 1, 0", "0.6, 2, 2") +
                                box("desk", "1, 1, 0.7", "2, 2, 0.74") +
                                object("leg",
                                       "cylinder: {from: [1.5, 1.5, 0], to: [1.5, 1.5, 0.7], "
                                       "radius: 0.05}") +
                                sheet("rug", "2, 2, 0", "1, 0, 0", "0, 1, 0", ", sides: front") +
                                sheet("poster", "4, 1, 1", "0, 0, 1", "0, 1, 0", ", sides: front"))
                  .warnings,
              IsEmpty());
}

TEST(Crossing, BodiesAndSheetsThatRunThroughEachOther) {
  EXPECT_THAT(
      inspect_room_with(box("a", "1, 1, 0.5", "2, 2, 1.5") + box("b", "1.5, 1.5, 1", "3, 3, 2"))
          .warnings,
      ElementsAre("'a' and 'b' run through each other"));
  EXPECT_THAT(inspect_room_with(object("a", "sphere: {center: [1, 1, 1], radius: 0.4}") +
                                object("b", "sphere: {center: [1.5, 1, 1], radius: 0.4}"))
                  .warnings,
              ElementsAre("'a' and 'b' run through each other"));
  EXPECT_THAT(inspect_room_with(sheet("a", "1, 1, 1", "1, 0, 0", "0, 1, 0") +
                                sheet("b", "1.5, 1, 0.5", "0, 1, 0", "0, 0, 1"))
                  .warnings,
              ElementsAre("'a' and 'b' run through each other"));
}

TEST(Crossing, NearMisses) {
  EXPECT_THAT(inspect_room_with(object("a", "sphere: {center: [1, 1, 1], radius: 0.4}") +
                                object("b", "sphere: {center: [1.8, 1, 1], radius: 0.4}"))
                  .warnings,
              IsEmpty());
  // A sheet that ends on another, and one that goes through a hole of it.
  EXPECT_THAT(inspect_room_with(sheet("a", "1, 1, 1", "1, 0, 0", "0, 1, 0") +
                                sheet("b", "1.5, 1, 1", "0, 1, 0", "0, 0, 1"))
                  .warnings,
              IsEmpty());
  EXPECT_THAT(
      inspect_room_with(
          object("frame",
                 "polygon: {points: [[1, 1, 1], [3, 1, 1], [3, 3, 1], [1, 3, 1]], holes: [[[1.5, "
                 "1.5, 1], [2.5, 1.5, 1], [2.5, 2.5, 1], [1.5, 2.5, 1]]]}") +
          sheet("through", "2, 1.6, 0.5", "0, 0.8, 0", "0, 0, 1"))
          .warnings,
      IsEmpty());
}

TEST(Crossing, MeshesOfManyTrianglesAreAskedByRays) {
  const std::string balls = object("a", "sphere: {center: [1, 1, 1], radius: 0.4}") +
                            object("b", "sphere: {center: [1.5, 1, 1], radius: 0.4}") +
                            object("c", "sphere: {center: [1, 3, 1], radius: 0.4}") +
                            object("d", "sphere: {center: [1, 3, 1], radius: 0.2}") +
                            object("e", "sphere: {center: [3, 1, 0.4], radius: 0.4}");
  const Scene scene = tessellated(scene_of(kRoom + balls), 64);
  EXPECT_THAT(inspect_scene(RayCaster(scene)).warnings,
              ElementsAre("'a' and 'b' run through each other",
                          "'d' lies inside 'c': light never gets there"));
}

TEST(Inspection, LargeMeshesTakeSeconds) {
  const Scene scene = tessellated(
      scene_of(kRoom + object("a", "sphere: {center: [1, 1, 1], radius: 0.4}") +
               object("b", "sphere: {center: [1.5, 1, 1], radius: 0.4}") +
               object("c", "sphere: {center: [3, 3, 1], radius: 0.4}", ", emission: {flux: 1}")),
      300);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(inspect_scene(RayCaster(scene)).warnings.size(), 1u) << "a and b";
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(Buried, WhatLiesInsideASolid) {
  EXPECT_THAT(inspect_room_with(object("ball", "sphere: {center: [2, 2, 1], radius: 0.5}") +
                                object("core", "sphere: {center: [2, 2, 1], radius: 0.2}"))
                  .warnings,
              ElementsAre("'core' lies inside 'ball': light never gets there"));
  EXPECT_THAT(inspect_room_with(box("far", "9, 9, 1", "9.5, 9.5, 2")).warnings,
              ElementsAre("'far' lies inside 'room': light never gets there"));
}

TEST(Buried, ALightInsideASolid) {
  EXPECT_THAT(inspect_room_with(object("ball", "sphere: {center: [2, 2, 1], radius: 0.5}") +
                                object("bulb", "sphere: {center: [2, 2, 1], radius: 0.2}",
                                       ", emission: {flux: 1}"))
                  .warnings,
              ElementsAre("light 'bulb' lies inside 'ball': its light goes nowhere"));
  // Inside the skin of a ball it is a lamp in its shade.
  EXPECT_THAT(inspect_room_with(object("shade",
                                       "cylinder: {from: [2, 2, 1], to: [2, 2, 1.5], radius: 0.5, "
                                       "open: true}") +
                                object("bulb", "sphere: {center: [2, 2, 1.2], radius: 0.2}",
                                       ", emission: {flux: 1}"))
                  .warnings,
              IsEmpty());
}

TEST(Inverted, ASheetSeenFromItsBlackSide) {
  const std::string up = sheet("ledge", "0.5, 0.5, 1", "3, 0, 0", "0, 3, 0", ", sides: front");
  EXPECT_THAT(inspect_room_with(up).warnings, IsEmpty());
  const std::string wall = sheet("wall", "0.01, 0, 0", "0, 0, 3", "0, 4, 0", ", sides: front");
  EXPECT_THAT(inspect_room_with(wall).warnings,
              ElementsAre(HasSubstr("'wall' is seen from behind by 100 % of the rays")));
  const std::string both = sheet("wall", "0.01, 0, 0", "0, 0, 3", "0, 4, 0");
  EXPECT_THAT(inspect_room_with(both).warnings, IsEmpty());
}

TEST(Inverted, ARoomThatIsABoxSeenFromWithin) {
  const std::string scene = kMaterials + R"(objects:
  - {name: room, shape: {box: {lower: [0, 0, 0], upper: [4, 4, 3]}}, material: m}
lights: [{name: bulb, point: {position: [2, 2, 2], flux: 100}}]
cameras: {eye: {eye: [1, 1, 1], look_at: [2, 2, 1]}}
)";
  EXPECT_THAT(inspect(scene).warnings, ElementsAre(HasSubstr("'room' is seen from behind by 100 %"),
                                                   HasSubstr("light 'bulb' shines at nothing")));
}

TEST(LostLight, ALampThatFacesTheSky) {
  const auto lamp = [](const char* u, const char* v) {
    return kMaterials + "objects:\n" +
           object("ground", "box: {lower: [-9, -9, -1], upper: [9, 9, 0]}") +
           sheet("lamp", "0, 0, 2", u, v, ", sides: front, emission: {flux: 100}");
  };
  EXPECT_THAT(inspect(lamp("1, 0, 0", "0, 1, 0")).warnings,
              ElementsAre(HasSubstr("light 'lamp' shines at nothing")));
  EXPECT_THAT(inspect(lamp("0, 1, 0", "1, 0, 0")).warnings, IsEmpty());
}

const std::string kSky = "sky: {type: overcast, illuminance: 10000}\n";

TEST(OpenToTheSky, NoLightIsLostThere) {
  const std::string ground =
      kMaterials + "objects:\n" + object("ground", "box: {lower: [-9, -9, -1], upper: [9, 9, 0]}");
  const auto lamp = [&](const char* u, const char* v) {
    return ground + sheet("lamp", "0, 0, 2", u, v, ", sides: front, emission: {flux: 100}") + kSky;
  };
  const Inspection up = inspect(lamp("1, 0, 0", "0, 1, 0"));
  EXPECT_THAT(up.warnings, IsEmpty());
  EXPECT_EQ(up.escaped, up.rays) << "told all the same";
  EXPECT_GT(up.rays, 0u);
  EXPECT_THAT(inspect(lamp("0, 1, 0", "1, 0, 0")).warnings, IsEmpty());
}

TEST(OpenToTheSky, EyesAreAskedWhereNothingElseShines) {
  const std::string ground =
      kMaterials + "objects:\n" + object("ground", "box: {lower: [-9, -9, -1], upper: [9, 9, 0]}");
  const Inspection nobody = inspect(ground + kSky);
  EXPECT_EQ(nobody.rays, 0u);
  EXPECT_THAT(nobody.warnings, IsEmpty());
  const Inspection seen =
      inspect(ground + kSky + "cameras: {eye: {eye: [0, 0, 2], look_at: [5, 5, 0]}}\n");
  EXPECT_GT(seen.escaped, 0u);
  EXPECT_THAT(seen.warnings, IsEmpty());
}

TEST(OpenToTheSky, AClosedRoomIsNot) {
  EXPECT_THAT(inspect_room_with(kSky).warnings,
              ElementsAre("no ray leaves the scene: the sky gives it no light"));
  EXPECT_THAT(inspect_room_with("sky: {type: uniform, zenith: 0}\n").warnings, IsEmpty());
}

TEST(NoArea, ASolidOfWhichNothingIsLeftAndASpeck) {
  EXPECT_THAT(inspect_room_with(object("gone",
                                       "difference: [{box: {lower: [1, 1, 1], upper: [2, "
                                       "2, 2]}}, {box: {lower: [0.5, 0.5, 0.5], upper: "
                                       "[2.5, 2.5, 2.5]}}]"))
                  .warnings,
              ElementsAre("no ray meets 'gone': nothing is left of it"));
  EXPECT_THAT(
      inspect_room_with(sheet("speck", "1, 1, 1", "0.000001, 0, 0", "0, 0.000001, 0")).warnings,
      ElementsAre(HasSubstr("'speck' has next to no area, 1e-12 m²")));
  EXPECT_THAT(inspect_room_with(sheet("thread", "1, 1, 1", "0.0001, 0, 0", "0, 1, 0")).warnings,
              IsEmpty());
}

TEST(Inspection, OfManyAlikeThreeAreNamed) {
  std::string balls;
  for (int i = 0; i < 9; ++i) {
    balls += object(fmt::format("b{}", i),
                    fmt::format("sphere: {{center: [{}, 2, 1], radius: 0.3}}", 0.5 + 0.35 * i));
  }
  const auto warnings = inspect_room_with(balls).warnings;
  ASSERT_EQ(warnings.size(), 4u);
  EXPECT_EQ(warnings[0], "'b0' and 'b1' run through each other");
  EXPECT_EQ(warnings[3], "and 5 more like that");
}

TEST(Inspection, RealScenesOfManyPolygonsAreClosed) {
  ISOLUX_NEED_SHARED();
  for (const char* name : {"soda.mgf", "office3/office.mgf"}) {
    const SceneFile file = load_scene_file(shared_dir() / "scenes/mgf-renderpark" / name);
    EXPECT_EQ(inspect_scene(RayCaster(file.scene)).escaped, 0u) << name;
  }
}

}  // namespace
}  // namespace isolux
