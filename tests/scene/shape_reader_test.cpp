#include <gmock/gmock.h>

#include <numbers>

#include "isolux/core/random.h"
#include "scene/scene_text.h"

namespace isolux {
namespace {

constexpr double kPi = std::numbers::pi;

std::shared_ptr<const Shape> shape(const std::string& text) {
  return read_object("    shape: {" + text + "}\n").shape;
}

/// Lengths along the line from `origin` that lie within the solid.
double thickness(const Shape& solid, const Ray& ray) {
  Hits hits;
  solid.intersect(ray, hits);
  double sum = 0;
  for (std::size_t i = 0; i + 1 < hits.size(); i += 2) sum += hits[i + 1].t - hits[i].t;
  return sum;
}

TEST(ShapeReader, EachShapeIsTheOneThatWasMeant) {
  struct Case {
    const char* text;
    double area;
    bool solid;
    Vec3 lower, upper;
  };
  const Case cases[] = {
      {"sphere: {center: [1, 2, 3], radius: 2}", 16 * kPi, true, {-1, 0, 1}, {3, 4, 5}},
      {"cylinder: {from: [0, 0, 1], to: [0, 0, 3], radius: 1}",
       6 * kPi,
       true,
       {-1, -1, 1},
       {1, 1, 3}},
      {"cylinder: {from: [0, 0, 1], to: [0, 0, 3], radius: 1, open: true}",
       4 * kPi,
       false,
       {-1, -1, 1},
       {1, 1, 3}},
      {"cone: {from: [0, 0, 0], to: [0, 0, 4], radii: [3, 0]}",
       24 * kPi,
       true,
       {-3, -3, 0},
       {3, 3, 4}},
      {"cone: {from: [0, 0, 0], to: [0, 0, 4], radii: [3, 0], open: true}",
       15 * kPi,
       false,
       {-3, -3, 0},
       {3, 3, 4}},
      {"disk: {center: [0, 0, 1], normal: z, radius: 2, inner_radius: 1}",
       3 * kPi,
       false,
       {-2, -2, 1},
       {2, 2, 1}},
      {"torus: {center: [0, 0, 0], axis: y, major_radius: 2, minor_radius: 1}",
       8 * kPi * kPi,
       true,
       {-3, -1, -3},
       {3, 1, 3}},
      {"box: {lower: [0, 0, 0], upper: [1, 2, 3]}", 22, true, {0, 0, 0}, {1, 2, 3}},
      {"box: {lower: [0, 0, 0], upper: [1, 2, 3], inward: true}", 22, true, {0, 0, 0}, {1, 2, 3}},
      {"parallelogram: {corner: [1, 1, 1], u: [2, 0, 0], v: [1, 3, 0]}",
       6,
       false,
       {1, 1, 1},
       {4, 4, 1}},
      {"polygon: {points: [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]]}",
       4,
       false,
       {0, 0, 0},
       {2, 2, 0}},
      {"mesh: {points: [[0, 0, 0], [2, 0, 0], [0, 2, 0]], triangles: [[0, 1, 2]]}",
       2,
       false,
       {0, 0, 0},
       {2, 2, 0}},
      {"prism: {points: [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], along: [0, 0, 3]}",
       32,
       true,
       {0, 0, 0},
       {2, 2, 3}},
      {"prism: {points: [[0, 0, 0], [6, 0, 0], [6, 6, 0], [0, 6, 0]], along: [0, 0, 4], "
       "center: [3, 3, 0], scale: 0}",
       96,
       true,
       {0, 0, 0},
       {6, 6, 4}},
      {"revolution: {center: [0, 0, 1], axis: z, profile: [[0, 0], [3, 0], [0, 4]]}",
       24 * kPi,
       true,
       {-3, -3, 1},
       {3, 3, 5}},
      {"revolution: {center: [0, 0, 0], axis: x, profile: [[1, 0], [1, 2]], open: true}",
       4 * kPi,
       false,
       {0, -1, -1},
       {2, 1, 1}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.text);
    const auto read = shape(c.text);
    EXPECT_NEAR(surface_area(*read).value_or(0), c.area, 1e-9 * c.area);
    EXPECT_EQ(read->solid(), c.solid);
    expect_near(read->bounds().lower, c.lower, 1e-9);
    expect_near(read->bounds().upper, c.upper, 1e-9);
  }
}

// A ball of strength 4 under the threshold 1 reaches to radius √(1 − √(1/4)).
TEST(ShapeReader, ABlobOfBalls) {
  const auto blob = shape(
      "blob: {threshold: 1, balls: [{center: [1, 0, 0], radius: 2, strength: 4}, "
      "{center: [9, 0, 0], radius: 1}]}");
  EXPECT_TRUE(blob->solid());
  EXPECT_NEAR(thickness(*blob, {{-10, 0, 0}, {1, 0, 0}}), 4 * std::sqrt(0.5), 1e-12);
}

// In metres, as its box is once its lengths are read.
TEST(ShapeReader, AnImplicitShape) {
  const auto ball = shape(
      "implicit: {function: x^2 + y^2 + z^2 - 0.25, lower: [-60 cm, -1, -1], upper: [1, 1, 1]}");
  EXPECT_TRUE(ball->solid());
  EXPECT_NEAR(thickness(*ball, {{-10, 0, 0}, {1, 0, 0}}), 1, 1e-12);
  EXPECT_NEAR(ball->bounds().lower.x, -0.6, 1e-15);
}

// Flat, but that its middle is drawn up: by 3/4 · 3/4 of 16 cm at (1/2, 1/2).
TEST(ShapeReader, ABezierSurface) {
  const auto sail = shape(
      "bezier: {patches: [[[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], "
      "[0, 1, 0], [1, 1, 16 cm], [2, 1, 16 cm], [3, 1, 0], "
      "[0, 2, 0], [1, 2, 16 cm], [2, 2, 16 cm], [3, 2, 0], "
      "[0, 3, 0], [1, 3, 0], [2, 3, 0], [3, 3, 0]]]}");
  EXPECT_FALSE(sail->solid());
  Hits hits;
  sail->intersect({{1.5, 1.5, 5}, {0, 0, -1}}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(hits[0].point.z, 0.09, 1e-15);
  EXPECT_LT(distance(hits[0].normal, {0, 0, 1}), 1e-12);
}

// A quarter of a tube: the middle weight of an arc of 90° is √½.
TEST(ShapeReader, ANurbsSurface) {
  const std::string net =
      "nurbs: {degrees: [2, 1], u_knots: [0, 0, 0, 1, 1, 1], v_knots: [0, 0, 1, 1], "
      "points: [[[1, 0, 0], [1, 1, 0], [0, 1, 0]], [[1, 0, 200 cm], [1, 1, 2], [0, 1, 2]]]";
  const auto tube =
      shape(net + ", weights: [[1, 0.70710678118654752, 1], " + "[1, 0.70710678118654752, 1]]}");
  EXPECT_FALSE(tube->solid());
  EXPECT_NEAR(surface_area(*tube).value(), kPi, 1e-9);
  const auto hit_from_axis = [](const Shape& surface) {
    Hits hits;
    surface.intersect({{0, 0, 1}, {3, 4, 0}}, hits);
    return hits.at(0);
  };
  EXPECT_LT(distance(hit_from_axis(*tube).point, {0.6, 0.8, 1}), 1e-14);
  EXPECT_LT(distance(hit_from_axis(*tube).normal, {0.6, 0.8, 0}), 1e-12);
  // Without weights it is a parabola's arc, with its vertex between the middle points.
  const auto parabola = shape(net + "}");
  Hits hits;
  parabola->intersect({{0, 0, 1}, {1, 1, 0}}, hits);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_LT(distance(hits[0].point, {0.75, 0.75, 1}), 1e-14);
}

// What stands in several places is counted once.
TEST(ShapeReader, PiecesOfAllPatchesAreCounted) {
  std::string points;
  Random random(1);
  for (int i = 0; i < 48; ++i) {
    points += (i % 3 == 0 ? i == 0 ? "[" : ", [" : ", ") + std::to_string(random.uniform()) +
              (i % 3 == 2 ? "]" : "");
  }
  const std::string crumpled = "{bezier: {patches: [[" + points + "]]}}";
  const auto scene = [&](const std::string& shapes, const std::string& shape) {
    std::string text = "isolux: 1\nmaterials: {gray: {reflectance: 0.5}}\n" + shapes +
                       "objects:\n  - {material: gray, shape: &first " + shape + "}\n";
    for (int i = 0; i < 4000; ++i) text += "  - {material: gray, shape: *first}\n";
    return text;
  };
  EXPECT_THAT(refusal(scene("", crumpled)),
              testing::HasSubstr(": the scene has more than 400000 pieces of curved patches"));
  EXPECT_EQ(refusal(scene("shapes: {ball: " + crumpled + "}\n", "{instance: ball}")), "");
}

TEST(ShapeReader, AnInwardBoxIsARoom) {
  const auto room = shape("box: {lower: [0, 0, 0], upper: [1, 1, 1], inward: true}");
  Hits hits;
  room->intersect({{0.5, 0.5, 0.5}, {0, 0, 1}}, hits);
  ASSERT_EQ(hits.size(), 2u);
  expect_near(hits[0].normal, {0, 0, 1});
  expect_near(hits[1].normal, {0, 0, -1});
}

const std::string kBalls =
    "{sphere: {center: [0, 0, 0], radius: 1}}, {sphere: {center: [1, 0, 0], radius: 1}}, "
    "{sphere: {center: [2, 0, 0], radius: 1}}";
const Ray kAlongX{{-10, 0, 0}, {1, 0, 0}};

TEST(ShapeReader, CsgJoinsAnyNumberInTheirOrder) {
  EXPECT_NEAR(thickness(*shape("union: [" + kBalls + "]"), kAlongX), 4, 1e-9);
  EXPECT_NEAR(thickness(*shape("difference: [" + kBalls + "]"), kAlongX), 1, 1e-9);
  EXPECT_NEAR(thickness(*shape("intersection: [{box: {lower: [-5, -5, -5], upper: [1.5, 5, 5]}}, "
                               "{sphere: {center: [0, 0, 0], radius: 4}}, "
                               "{sphere: {center: [3, 0, 0], radius: 2.5}}]"),
                        kAlongX),
              1, 1e-9);
}

TEST(ShapeReader, CsgNestsAndTransformsWithin) {
  const auto solid = shape("difference: [{union: [" + kBalls +
                           "]}, {box: {lower: [0, 0, 0], upper: [1, 1, 1]}, transform: "
                           "[{translate: [0, -0.5, -0.5]}]}], "
                           "transform: [{scale: 10}]");
  EXPECT_NEAR(thickness(*solid, kAlongX), 30, 1e-9);
}

TEST(ShapeReader, AComplementIsTheSolidSeenFromInside) {
  const auto hollow = shape("complement: {union: [" + kBalls + "]}");
  EXPECT_TRUE(hollow->solid());
  EXPECT_TRUE(hollow->unbounded());
  EXPECT_FALSE(hollow->contains({1, 0, 0}));
  EXPECT_TRUE(hollow->contains({5, 0, 0}));
  Hits hits;
  hollow->intersect(kAlongX, hits);
  ASSERT_EQ(hits.size(), 2u);
  expect_near(hits[0].normal, {1, 0, 0});
}

TEST(ShapeReader, AUnionOfThousandsIsNoDeepTree) {
  std::string text = "union: [";
  for (int i = 0; i < 20'000; ++i) {
    text += "{sphere: {center: [" + std::to_string(2 * i) + ", 0, 0], radius: 0.5}}, ";
  }
  EXPECT_NEAR(thickness(*shape(text + kBalls + "]"), {{-10, 0, 0.4}, {1, 0, 0}}), 0, 1e5);
}

TEST(ShapeReader, DirectionsAreVectorsOrAxes) {
  for (const char* normal : {"-z", "[0, 0, -7]", "[0, 0, -1e300]", "[0, 0, -1e-300]"}) {
    Hits hits;
    shape("disk: {center: [0, 0, 0], normal: " + std::string(normal) + ", radius: 1}")
        ->intersect({{0, 0, 5}, {0, 0, -1}}, hits);
    ASSERT_EQ(hits.size(), 1u) << normal;
    expect_near(hits[0].normal, {0, 0, -1});
  }
}

TEST(ShapeReader, AliasesRepeatAShape) {
  const Scene scene = read_scene(
      "isolux: 1\n"
      "materials: {gray: {reflectance: 0.5}}\n"
      "objects:\n"
      "  - {shape: &ball {sphere: {center: [0, 0, 0], radius: 1}}, material: gray}\n"
      "  - {shape: *ball, material: gray, transform: [{translate: [5, 0, 0]}]}\n",
      "test.yaml");
  expect_near(scene.objects[1].shape->bounds().center(), {5, 0, 0}, 1e-9);
}

}  // namespace
}  // namespace isolux
