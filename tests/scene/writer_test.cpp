#include "isolux/scene/writer.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "geometry/zoo.h"
#include "isolux/geometry/box.h"
#include "isolux/geometry/complement.h"
#include "isolux/geometry/csg.h"
#include "isolux/geometry/instance.h"
#include "isolux/geometry/parallelogram.h"
#include "isolux/geometry/shape_description.h"
#include "isolux/geometry/sphere.h"
#include "scene/scene_text.h"

namespace isolux {
namespace {

using testing::HasSubstr;

Scene scene_with(ShapePtr shape) {
  Scene scene;
  scene.materials = {{"gray", gray(0.5)}};
  scene.objects = {{"thing", std::move(shape), 0, Sides::front, {}}};
  return scene;
}

Scene read_back(const Scene& scene) { return read_scene(write_scene(scene), "written"); }

/// Number of hits of a thousand lines with both shapes, which must agree to 1e-12 of their size.
std::size_t expect_same_hits(const Shape& a, const Shape& b, const std::string& name) {
  Random random(1);
  const Bounds bounds = a.bounds();
  const double size = bounds.diagonal();
  std::size_t count = 0;
  for (int i = 0; i < 1000; ++i) {
    const Ray ray = random_line(random, bounds.center(), size / 2, size);
    const Hits expected = hits_of(a, ray), found = hits_of(b, ray);
    EXPECT_EQ(expected.size(), found.size()) << name << ", line " << i;
    if (expected.size() != found.size()) return 0;
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_LE(distance(expected[k].point, found[k].point), 1e-12 * size) << name;
      EXPECT_LE(distance(expected[k].normal, found[k].normal), 1e-11) << name;
      EXPECT_EQ(expected[k].face, found[k].face) << name;
    }
    count += found.size();
  }
  return count;
}

TEST(Writer, EveryShapeIsReadBackWithItsHits) {
  for (const Specimen& specimen : zoo()) {
    const Scene scene = scene_with(specimen.shape);
    const std::string text = write_scene(scene);
    const Scene back = read_scene(text, specimen.name);
    EXPECT_EQ(write_scene(back), text);
    EXPECT_GT(expect_same_hits(*specimen.shape, *back.objects[0].shape, specimen.name), 10u);
    EXPECT_EQ(back.objects[0].shape->solid(), specimen.shape->solid());
    EXPECT_EQ(back.objects[0].shape->unbounded(), specimen.shape->unbounded());
  }
}

TEST(Writer, EveryExampleIsReadBackAsItWas) {
  std::size_t examples = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(ISOLUX_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".yaml") continue;
    if (entry.path().stem().extension() == ".lights") continue;  // beside a model of another format
    ++examples;
    const Scene scene = load_scene(entry.path());
    const std::string text = write_scene(scene);
    const Scene back = read_scene(text, entry.path().string());
    EXPECT_EQ(write_scene(back), text);

    EXPECT_EQ(back.name, scene.name);
    ASSERT_EQ(back.objects.size(), scene.objects.size());
    std::size_t hits = 0;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const Object &a = scene.objects[i], &b = back.objects[i];
      EXPECT_EQ(b.name, a.name);
      EXPECT_EQ(b.sides, a.sides);
      EXPECT_EQ(b.exitance, a.exitance);
      EXPECT_NEAR(luminous_flux(b), luminous_flux(a), 1e-6 * luminous_flux(a));
      EXPECT_EQ(back.material_of(static_cast<std::uint32_t>(i)).reflectance,
                scene.material_of(static_cast<std::uint32_t>(i)).reflectance);
      hits += expect_same_hits(*a.shape, *b.shape, a.name);
    }
    EXPECT_GT(hits, 1000u);
    ASSERT_EQ(back.cameras.size(), scene.cameras.size());
    for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
      const Camera &a = scene.cameras[i], &b = back.cameras[i];
      EXPECT_EQ(b.name, a.name);
      EXPECT_EQ(b.eye, a.eye);
      EXPECT_EQ(b.look_at, a.look_at);
      EXPECT_EQ(b.up, a.up);
      EXPECT_EQ(b.fov, a.fov);
      EXPECT_EQ(b.width, a.width);
      EXPECT_EQ(b.height, a.height);
    }
  }
  EXPECT_GE(examples, 4u);
}

TEST(Writer, TextIsLaidOutForPeople) {
  Scene scene = read_scene(
      "isolux: 1\n"
      "unit: cm\n"
      "name: hall\n"
      "materials: {plaster: {reflectance: 0.7}, lamp: {reflectance: [0, 0, 0.1]}}\n"
      "objects:\n"
      "  - {shape: {box: {lower: [0, 0, 0], upper: [400, 500, 250], inward: true}}, material: "
      "plaster}\n"
      "  - name: light\n"
      "    shape: {disk: {center: [200, 200, 250], normal: -z, radius: 50}}\n"
      "    material: lamp\n"
      "    sides: front\n"
      "    emission: {exitance: 1000}\n"
      "cameras: {door: {eye: [10, 10, 150], look_at: [200, 300, 100]}}\n",
      "test.yaml");
  EXPECT_EQ(write_scene(scene),
            "isolux: 1\n"
            "name: hall\n"
            "\n"
            "materials:\n"
            "  plaster: {reflectance: 0.7}\n"
            "  lamp: {reflectance: [0, 0, 0.1]}\n"
            "\n"
            "objects:\n"
            "  - name: box 1\n"
            "    shape: {box: {lower: [0, 0, 0], upper: [4, 5, 2.5], inward: true}}\n"
            "    material: plaster\n"
            "  - name: light\n"
            "    shape: {disk: {center: [2, 2, 2.5], normal: [0, 0, -1], radius: 0.5}}\n"
            "    material: lamp\n"
            "    sides: front\n"
            "    emission: {exitance: 1000}\n"
            "\n"
            "cameras:\n"
            "  door: {eye: [0.1, 0.1, 1.5], look_at: [2, 3, 1], fov: 50, size: [800, 600]}\n");
}

TEST(Writer, LongShapesTakeALineForEachPart) {
  const auto ball = std::make_shared<Sphere>(Vec3{1.0 / 3, 0, 0}, 0.5);
  const auto box = std::make_shared<Box>(Vec3{-0.123456789, -1, -1}, Vec3{1, 1, 1.23456789012345});
  Affine map = Affine::rotate({1, 2, 3}, 0.5);
  map.translation = {0, 0, 1};
  const auto solid = std::make_shared<Instance>(
      std::make_shared<Csg>(CsgOperation::subtract, box, std::make_shared<Complement>(ball)), map);
  EXPECT_THAT(write_scene(scene_with(solid)),
              HasSubstr("    shape:\n"
                        "      difference:\n"
                        "        - box: {lower: [-0.123456789, -1, -1], upper: [1, 1, "
                        "1.23456789012345]}\n"
                        "        - complement: {sphere: {center: [0.3333333333333333, 0, 0], "
                        "radius: 0.5}}\n"
                        "      transform:\n"
                        "        - matrix:\n"
                        "            - ["));
}

TEST(Writer, CsgOfOneKindIsOneList) {
  const auto ball = [](double x) { return std::make_shared<Sphere>(Vec3{x, 0, 0}, 0.75); };
  ShapePtr row = ball(0);
  for (int i = 1; i < 200; ++i) row = std::make_shared<Csg>(CsgOperation::unite, row, ball(i));
  // Two hundred deep as it is, eight deep when read back.
  const Scene back = read_back(scene_with(row));
  EXPECT_GT(expect_same_hits(*row, *back.objects[0].shape, "row"), 10u);

  ShapePtr rest = std::make_shared<Box>(Vec3{-1, -1, -1}, Vec3{9, 1, 1});
  for (int i = 0; i < 8; ++i) {
    rest = std::make_shared<Csg>(CsgOperation::subtract, rest, ball(i));
  }
  EXPECT_EQ(rest->describe().operands.size(), 9u);
  EXPECT_GT(expect_same_hits(*rest, *read_back(scene_with(rest)).objects[0].shape, "rest"), 100u);
}

TEST(Writer, MovedShapesSayByHowMuch) {
  const auto ball = std::make_shared<Sphere>(Vec3{}, 1);
  const auto once = std::make_shared<Instance>(ball, Affine::translate({1, 2, 3}));
  const auto twice = std::make_shared<Instance>(once, Affine::translate({0, 0, 0.5}));
  EXPECT_THAT(write_scene(scene_with(twice)),
              HasSubstr("shape: {sphere: {center: [0, 0, 0], radius: 1}, transform: "
                        "[{translate: [1, 2, 3.5]}]}\n"));
}

TEST(Writer, NumbersKeepEveryBit) {
  const Vec3 center{0.1 + 0.2, -1e-300, 123456789.12345678};
  const Scene back = read_back(scene_with(std::make_shared<Sphere>(center, std::nextafter(1, 2))));
  const ShapeDescription ball = back.objects[0].shape->describe();
  EXPECT_EQ(*ball.find<Vec3>("center"), center);
  EXPECT_EQ(*ball.find<double>("radius"), std::nextafter(1, 2));
}

TEST(Writer, EveryNameIsReadBack) {
  const std::vector<std::string> names = {
      "plain name",  "null",       "~",          "Yes",       "12",       "0.5 m",
      "- item",      "a: b",       "a #b",       "'quoted'",  "\"both\"", "back\\slash",
      "line\nbreak", "tab\there",  " spaces ",   "[list]",    "{map}",    "&anchor",
      "*alias",      "!tag",       "%directive", "@at",       "`tick",    "Säule № 3",
      "<<",          "isolux: 1",  "?",          "trailing:", "-",        std::string("\0x", 2),
      ".inf",        "\x7f\x1b[0m"};
  Scene scene = scene_with(std::make_shared<Sphere>(Vec3{}, 1));
  scene.name = names[7];
  for (const std::string& name : names) {
    scene.materials.push_back({name, gray(0.25)});
    scene.objects.push_back(scene.objects[0]);
    scene.objects.back().name = name;
    scene.cameras.push_back({name, {}, {1, 0, 0}});
  }
  const Scene back = read_back(scene);
  EXPECT_EQ(back.name, names[7]);
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(back.materials[i + 1].name, names[i]);
    EXPECT_EQ(back.objects[i + 1].name, names[i]);
    EXPECT_EQ(back.cameras[i].name, names[i]);
  }
}

TEST(Writer, NamesThatCantBeKeysGetOthers) {
  Scene scene = scene_with(std::make_shared<Sphere>(Vec3{}, 1));
  const std::string longest(5000, 'x');
  scene.materials = {{"wall", gray(0.1)}, {"wall", gray(0.2)},  {"", gray(0.3)},
                     {"", gray(0.4)},     {longest, gray(0.5)}, {"wall 2", gray(0.6)},
                     {"\xff", gray(0.7)}};
  scene.objects[0].name = "";
  scene.objects[0].material = 5;
  const std::string text = write_scene(scene);
  const Scene back = read_scene(text, "written");
  std::vector<std::string> names;
  for (const Material& material : back.materials) names.push_back(material.name);
  EXPECT_THAT(names, testing::ElementsAre("wall", "wall 2", "material", "material 2",
                                          longest.substr(0, 180), "wall 2 2", "?"));
  EXPECT_EQ(back.material_of(0).reflectance, gray(0.6));
  EXPECT_EQ(back.objects[0].name, "sphere 1");
  EXPECT_EQ(write_scene(back), text);
}

TEST(Writer, SidesAreWrittenWhereTheyAreNotTheDefault) {
  const auto sheet = std::make_shared<Parallelogram>(Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0});
  Scene scene = scene_with(sheet);
  EXPECT_THAT(write_scene(scene), HasSubstr("sides: front"));
  EXPECT_EQ(read_back(scene).objects[0].sides, Sides::front);
  scene.objects[0].sides = Sides::both;
  EXPECT_THAT(write_scene(scene), Not(HasSubstr("sides")));
  EXPECT_EQ(read_back(scene).objects[0].sides, Sides::both);
}

TEST(Writer, LightsWithoutASurfaceKeepEveryBit) {
  const Scene scene = read_scene(
      scene_text("    shape: {sphere: {center: [0, 0, 0], radius: 1}}\n") +
          "lights:\n"
          "  - {name: bulb, point: {position: [0.1, 2, 3], flux: 806, color: [1, 0.9, 0.7]}}\n"
          "  - spot: {position: [0, 0, 3], look_at: [0.3, 0.1, 0], angles: [17.3, 30], flux: 500}\n"
          "  - directional: {direction: [1, 2, -3], illuminance: 80000}\n",
      "test");
  const std::string text = write_scene(scene);
  const Scene back = read_scene(text, "written");
  EXPECT_EQ(write_scene(back), text);
  ASSERT_EQ(back.sources.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Source &a = scene.sources[i], &b = back.sources[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_EQ(a.intensity, b.intensity);
    EXPECT_EQ(a.full_angle, b.full_angle);
    EXPECT_EQ(a.dark_angle, b.dark_angle);
  }
}

TEST(Writer, SkiesKeepEveryBit) {
  const Scene plain = scene_with(std::make_shared<Sphere>(Vec3{}, 1));
  EXPECT_THAT(write_scene(plain), Not(HasSubstr("sky")));
  for (const char* yaml :
       {"{type: overcast, illuminance: 12345.6}",
        "{type: 7, sun: [0.3, -1, 0.7], illuminance: 9876, color: [0.9, 0.95, 1.1]}",
        "{distribution: [-1, -0.31, 9.7, -3, 0.44], sun: [0.1, 0.2, 0.3], zenith: [0.1, 0.7, 3], "
        "ground: 300, up: [0.1, 0, 1]}",
        "{distribution: [0, -0.2, 0, -1, 0], sun: [0.1, 0.2, 0.3], zenith: 1, up: y}",
        "{type: uniform, zenith: 0.1, ground: [0.3, 0.2, 0.1], up: [1, 2, 3]}"}) {
    Scene scene = plain;
    scene.sky = read_scene(write_scene(plain) + "sky: " + yaml + "\n", "test").sky;
    const std::string text = write_scene(scene);
    const Scene back = read_scene(text, "written");
    EXPECT_EQ(write_scene(back), text);
    ASSERT_TRUE(back.sky) << yaml;
    EXPECT_EQ(back.sky->distribution, scene.sky->distribution) << yaml;
    EXPECT_EQ(back.sky->up, scene.sky->up) << yaml;
    EXPECT_EQ(back.sky->sun, scene.sky->sun) << yaml;
    EXPECT_EQ(back.sky->zenith, scene.sky->zenith) << yaml;
    EXPECT_EQ(back.sky->ground, scene.sky->ground) << yaml;
  }
}

TEST(Writer, SkiesAreLaidOutForPeople) {
  Scene scene = scene_with(std::make_shared<Sphere>(Vec3{}, 1));
  scene.sky = Sky{standard_sky(12), {0, 0, 1}, {0, -0.6, 0.8}, gray(4000), gray(300)};
  EXPECT_THAT(write_scene(scene), HasSubstr("\n"
                                            "sky:\n"
                                            "  type: 12\n"
                                            "  sun: [0, -0.6, 0.8]\n"
                                            "  zenith: 4000\n"
                                            "  ground: 300\n"));
}

}  // namespace
}  // namespace isolux
